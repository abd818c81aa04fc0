//! Stops and marks: where their terms rise through zero in a step, and which become true with a switch.

use super::Run;
use super::guard_polynomials::Located;
use super::hit::Hit;
use super::instant::nearest;
use crate::arithmetic::{Scalar, epsilon};
use crate::dynamics::OutputMask;
use crate::error::Error;
use crate::events::{Direction, Root, find_root_until};
use crate::integrate::{polynomial_derivative as slope, polynomial_value as value};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::system::Watch;
use crate::trajectory::{EventKind, Subject};
use core::ops::ControlFlow::{Break, Continue};

/// Coefficients this much smaller than all together cannot be told from 0: some degrees times rounding.
pub(super) const RESOLUTION: f64 = 1e-13;

/// Terms of higher order are not counted beyond so many times the first ones.
const LATER: f64 = 64.0;

/// So many units of rounding are between the time of a root and of the same one when the next step begins.
const UNITS_OF_TIME: f64 = 64.0;

/// Roots of interpolations are looked for so much farther than they may be when they are sharpened.
const FARTHER: f64 = 1.25;

/// A term of a stop or of a mark over the step.
#[derive(Clone, Copy)]
struct Term<'c> {
    guard: Guard,
    curve: &'c [f64],
    /// Its value where the step ends.
    at_end: f64,
    /// Whether it was below zero when the step began.
    was_below: bool,
    /// The part of the step up to which a zero is the one with which it begins, seen before.
    known: Option<f64>,
}

impl<T: Scalar> Run<T> {
    /// Asks for the stops and marks that take part.
    pub(super) fn watch(&mut self) {
        let d = self.description();
        let mut needs = OutputMask::new(d);
        for &i in &self.locator.polynomials.stops {
            needs.insert(d.stops[i].need);
        }
        for &i in &self.locator.polynomials.marks {
            needs.insert(d.marks[i].need);
        }
        self.dynamics.set_report_needs(&needs);
    }

    /// A mark that begins below zero has not passed it: remembers on which side the marks begin.
    pub(super) fn begin_sides(&mut self) {
        let reading = Reading::Series(&self.dynamics);
        for (i, below) in self.locator.mark_below.iter_mut().enumerate() {
            for (k, below) in below.iter_mut().enumerate() {
                *below = guard::value(Guard::Mark(i, k), &self.now.mode, &reading) < 0.0;
            }
        }
    }

    /// The earliest stop up to part `end` of the step.
    pub(super) fn first_stop(&self, end: f64) -> Option<(usize, f64)> {
        let d = self.description();
        let resolution = self.resolution_of_time();
        let curves = &self.locator.polynomials;
        let mut best: Option<(usize, f64)> = None;
        for &i in &curves.stops {
            let below = &self.locator.stop_below[i];
            let term = |k: usize| {
                let curve = curves.stop_term(i, k);
                Term {
                    guard: Guard::Stop(i, k),
                    curve,
                    at_end: curves.stop_end(i, k),
                    was_below: below[k],
                    known: self.known_zero(curve, below[k], None, resolution),
                }
            };
            self.becomes_true(&d.stops[i], [end; 2], term, |s| {
                if best.is_none_or(|(_, t)| s < t) {
                    best = Some((i, s));
                }
            });
        }
        best
    }

    /// Marks up to part `end` of the step, in order.
    pub(super) fn marks_until(&self, end: f64, list: &mut Vec<(usize, f64)>) {
        let d = self.description();
        let resolution = self.resolution_of_time();
        // A mark at the surface of a contact is passed where the contact is hit, whichever of both roots rounding puts first.
        let last = end + resolution;
        let curves = &self.locator.polynomials;
        list.clear();
        for &i in &curves.marks {
            let watch = &d.marks[i];
            if watch.zeros {
                if self.is_still(Guard::Mark(i, 0)) {
                    continue;
                }
                let curve = curves.mark_term(i, 0);
                let below = self.locator.mark_below[i][0];
                let known = self.known_zero(curve, below, Some((i, 0)), resolution);
                let begins_below = side_of_start(curve, resolution);
                let passes = known.is_none() && begins_below.is_some_and(|begins| begins != below);
                let known = match passes {
                    true => zero_at_start(curve, resolution),
                    false => known,
                };
                if passes {
                    list.push((i, 0.0));
                }
                let taken = self.now.mode.satisfies(watch.conditions);
                let mut latest = 0.0;
                find_root_until(curve, FARTHER * last, |root| {
                    let s = self.place_of_watch(Guard::Mark(i, 0), curve, &root, end);
                    let is_known = known.is_some_and(|until| root.s <= until);
                    if taken && !is_known && s <= last {
                        list.push((i, s.min(end)));
                        latest = s;
                    }
                    Continue::<(), ()>(())
                });
                let at_end = curves.mark_end(i, 0);
                if taken && self.passes_last(Guard::Mark(i, 0), end, curve, at_end, latest) {
                    list.push((i, end));
                }
            } else {
                let below = &self.locator.mark_below[i];
                let term = |k: usize| {
                    let curve = curves.mark_term(i, k);
                    Term {
                        guard: Guard::Mark(i, k),
                        curve,
                        at_end: curves.mark_end(i, k),
                        was_below: below[k],
                        known: self.known_zero(curve, below[k], Some((i, k)), resolution),
                    }
                };
                // Terms that rise at the same instant make the mark true once.
                let first = list.len();
                self.becomes_true(watch, [end, last], term, |s| {
                    let s = s.min(end);
                    let mut own = list[first..].iter();
                    if !own.any(|(_, other)| (s - other).abs() <= resolution) {
                        list.push((i, s));
                    }
                });
            }
        }
        list.sort_by(|a, b| a.1.total_cmp(&b.1));
    }

    /// Visits the instants up to part `end` of the step, or up to `last` where rounding may have put them, at which a watch becomes true: a term rises
    /// through zero while the others are true.
    fn becomes_true<'c>(
        &self,
        watch: &Watch,
        [end, last]: [f64; 2],
        term: impl Fn(usize) -> Term<'c>,
        mut visit: impl FnMut(f64),
    ) {
        if !self.now.mode.satisfies(watch.conditions) {
            return;
        }
        for k in 0..watch.terms.len() {
            let Term {
                guard,
                curve,
                at_end,
                was_below,
                known,
            } = term(k);
            let others =
                |s: f64| (0..watch.terms.len()).all(|j| j == k || self.is_true(term(j), s));
            let mut consider = |s: f64| {
                if s <= last && others(s) {
                    visit(s);
                }
            };
            // What stays zero has come there by an impact, or else its root has been seen.
            let stays = self.is_still(guard);
            let begins = match stays {
                true => self.begins_with_impact(),
                false => begins_true(curve, self.resolution_of_time()),
            };
            if was_below && known.is_none() && begins {
                consider(0.0);
            }
            if stays {
                continue;
            }
            let mut latest = 0.0;
            find_root_until(curve, FARTHER * last, |root| {
                let s = self.place_of_watch(guard, curve, &root, end);
                if s > last {
                    return Break(());
                }
                latest = s;
                let rises = root.direction == Direction::Rising && !root.grazing;
                let is_known = known.is_some_and(|until| root.s <= until);
                if rises && !is_known {
                    consider(s);
                }
                Continue(())
            });
            if self.passes_last(guard, end, curve, at_end, latest) && slope(curve, end) > 0.0 {
                consider(end);
            }
        }
    }

    /// Whether the step begins where something has been hit.
    fn begins_with_impact(&self) -> bool {
        let (events, t) = (
            self.recorder.trajectory.events.iter().rev(),
            self.stepper.step.t,
        );
        let mut here = events.take_while(|event| event.time == t);
        here.any(|event| event.kind == EventKind::Impact)
    }

    /// Notes which terms of stops and marks vanish where guards fall, as values tell, which `dynamics` holds there: a slow motion does not resolve the time.
    fn note_watches_at(&mut self, hit: &Hit) {
        let falls = matches!(hit, Hit::Guards(end) if *end > 0.0);
        if !falls || self.locator.polynomials.watches().is_empty() {
            return;
        }
        self.dynamics.report_value();
        let (curves, mode) = (&self.locator.polynomials, &self.now.mode);
        for (index, &term) in curves.watches().iter().enumerate() {
            let within = curves.zero(index, mode, &self.dynamics, Located::Exactly);
            if curves.value(index, mode, &self.dynamics).abs() <= within {
                self.locator.vanishing.push((term, within));
            }
        }
    }

    /// What ends the step, which is a stop if that becomes true where guards fall: it ends the run before what they lead to.
    pub(super) fn stop_where_guards_fall(&mut self, hit: Hit) -> Hit {
        self.note_watches_at(&hit);
        if self.locator.vanishing.is_empty() {
            return hit;
        }
        let stop = self.first_stop(hit.end());
        stop.map_or(hit, |(stop, s)| Hit::Stop(stop, s))
    }

    /// Whether a guard passes zero with the end of the step at part `end` of it, where its curve is `at_end`, whatever rounding makes of its value there,
    /// because no step follows that would find that: something else happens where it vanishes, or the run ends. The `latest` of its other zeros is before.
    pub(super) fn passes_last(
        &self,
        guard: Guard,
        end: f64,
        curve: &[f64],
        at_end: f64,
        latest: f64,
    ) -> bool {
        let (t, h) = (self.stepper.step.t.value(), self.stepper.step.h.value());
        let resolution = self.resolution_of_time();
        let is_last = || end >= 1.0 && self.is_spent(self.end - (t + h));
        let vanishes = match self.vanishes_with_end(guard) {
            Some(within) => (end - latest) * slope(curve, end).abs() > within,
            None => is_last() && is_zero(curve, 1.0, at_end, resolution),
        };
        if !vanishes || latest >= end - resolution {
            return false;
        }
        let between = 0.5 * (latest + end);
        let before = value(curve, between);
        before * slope(curve, end) < 0.0 && !is_zero(curve, between, before, resolution)
    }

    /// Where the root of a term is in a step up to part `end`: there, if the term vanishes with what falls there and rounding explains what is between.
    fn place_of_watch(&self, term: Guard, curve: &[f64], root: &Root, end: f64) -> f64 {
        let (s, _) = self.place(term, root);
        let apart = (s - end).abs();
        let explained = |within: f64| apart * slope(curve, end).abs() <= within;
        let with_end = apart > self.resolution_of_time()
            && self.vanishes_with_end(term).is_some_and(explained);
        if with_end { end } else { s }
    }

    /// If a term vanishes where guards fall: up to which size it counts as zero there, and as much at its root.
    fn vanishes_with_end(&self, term: Guard) -> Option<f64> {
        let mut vanishing = self.locator.vanishing.iter();
        let found = vanishing.find(|(other, _)| *other == term);
        found.map(|(_, within)| 2.0 * within)
    }

    /// Whether a term is true at part `s` of the step or becomes so there, as far as rounding can tell.
    fn is_true(&self, term: Term<'_>, s: f64) -> bool {
        let s = self.interpolated(term.guard, s);
        let now = match s < 1.0 {
            true => value(term.curve, s),
            false => term.at_end,
        };
        now >= 0.0
            || is_zero(term.curve, s, now, self.resolution_of_time()) && slope(term.curve, s) > 0.0
    }

    /// The part of the step up to which a zero of a term of a stop, or of one of a `mark`, is the one with which the step begins, if it does and that is
    /// known: the run starts there; or it has been logged and an impact has turned the term back; or the term crosses zero once more only because
    /// rounding has put it back to the side from which it has come, or, by no more than the tolerance, the projection onto the constraints after
    /// the step in which it passed.
    fn known_zero(
        &self,
        curve: &[f64],
        was_below: bool,
        mark: Option<(usize, usize)>,
        resolution: f64,
    ) -> Option<f64> {
        let step = &self.stepper.step;
        let logged = mark.is_some_and(|(i, k)| self.locator.mark_passed[i] == Some(k));
        let within = match logged {
            true => self.settings.tolerance * (step.t.value() / step.h.value()).abs().max(1.0),
            false => resolution,
        };
        let starts = self.recorder.trajectory.work.steps == 0;
        let known = starts || logged || comes_back_at_once(curve, was_below);
        known.then(|| zero_at_start(curve, within)).flatten()
    }

    /// The part of the step to which rounding resolves the time of an event.
    fn resolution_of_time(&self) -> f64 {
        let (t, h) = (self.stepper.step.t.value(), self.stepper.step.h.value());
        UNITS_OF_TIME * epsilon::<T>() * t.abs().max((t + h).abs()) / h.abs()
    }

    /// Remembers on which side the terms of stops and marks are at part `end` of the step. The term of a mark that has been logged there is on
    /// the side to which it goes.
    pub(super) fn remember_sides(&mut self, end: f64) {
        let d = self.description();
        let resolution = self.resolution_of_time();
        let curves = &self.locator.polynomials;
        for &i in &curves.stops {
            for (k, below) in self.locator.stop_below[i].iter_mut().enumerate() {
                let still = &self.locator.still;
                if still.contains(Guard::Stop(i, k), &self.now.mode) {
                    *below = false;
                } else if !curves.stop_stays(i, k, *below) {
                    *below = is_below(curves.stop_term(i, k), end, resolution, *below);
                }
            }
        }
        for &i in &curves.marks {
            let here = |&(mark, s): &(usize, f64)| mark == i && (end - s).abs() <= resolution;
            let logged = self.locator.marks.iter().any(here);
            let below = &mut self.locator.mark_below[i];
            let passed = match logged {
                true => nearest(0..below.len(), end, |k| curves.mark_term(i, k)),
                false => None,
            };
            for (k, below) in below.iter_mut().enumerate() {
                if self
                    .locator
                    .still
                    .contains(Guard::Mark(i, k), &self.now.mode)
                {
                    *below &= d.marks[i].zeros;
                    continue;
                }
                *below = match passed {
                    Some((term, slope)) if term == k => slope < 0.0,
                    _ => is_below(curves.mark_term(i, k), end, resolution, *below),
                };
            }
            self.locator.mark_passed[i] = passed.map(|(term, _)| term);
        }
    }

    /// Writes down the marks up to part `end` of the step, none of them after what ends it at part `last`, whatever rounding makes of their instants.
    /// The part at which the run ends after a mark, if it does before that.
    pub(super) fn log_marks(&mut self, end: f64, last: f64) -> Option<T> {
        if self.locator.polynomials.marks.is_empty() {
            return None;
        }
        let mut marks = core::mem::take(&mut self.locator.marks);
        self.marks_until(end, &mut marks);
        if !marks.is_empty() && self.look_for_still_watches(end) {
            self.marks_until(end, &mut marks);
        }
        let part = self.resolution_of_time();
        let resolution = part * self.stepper.step.h.value();
        let mut ends: Option<T> = None;
        for &(mark, s) in &marks {
            let s = self.sharpened_mark(mark, s).min(last);
            // Those of the same instant are passed with the last one.
            if ends.is_some_and(|ends| s > ends.value() + part) {
                break;
            }
            let s = self.exact_mark(mark, s);
            let time = self.stepper.step.time(s);
            // Where a guard jumps steps are as short as time resolves, and rounding may put a term back to the side from which it has come; each of both
            // times is known to within the resolution.
            let before = core::mem::replace(&mut self.locator.mark_times[mark], time.value());
            if time.value() - before <= 2.0 * resolution {
                continue;
            }
            self.now.valued = false;
            self.evaluate_at_or_before(s);
            let state = core::mem::take(&mut self.stepper.scratch);
            self.log_watch(Subject::Mark(mark), EventKind::Mark, time, &state);
            self.stepper.scratch = state;
            // What happens at the end of the step happens with a mark there.
            if s.value() < last - part && self.has_seen_all() {
                ends = Some(s);
            }
        }
        self.locator.marks = marks;
        ends
    }

    /// Stops whose conditions the switch has just made true.
    pub(super) fn stops_of_the_mode(&mut self) -> Result<(), Error> {
        let d = self.description();
        for at in 0..self.locator.polynomials.stops.len() {
            let i = self.locator.polynomials.stops[at];
            if self.has_become_true(&d.stops[i], |k| Guard::Stop(i, k)) {
                self.evaluate()?;
                self.finish(i);
                return Ok(());
            }
        }
        for at in 0..self.locator.polynomials.marks.len() {
            let i = self.locator.polynomials.marks[at];
            if self.has_become_true(&d.marks[i], |k| Guard::Mark(i, k)) {
                self.evaluate()?;
                // The next step would find it at its start.
                self.locator.mark_times[i] = self.now.t.value();
                self.log_here(Subject::Mark(i), EventKind::Mark);
            }
        }
        Ok(())
    }

    /// Whether the switch has made the conditions of a watch hold while its terms do.
    fn has_become_true(&self, watch: &Watch, term: impl Fn(usize) -> Guard) -> bool {
        let reading = Reading::Series(&self.dynamics);
        let value = |k| guard::value(term(k), &self.now.mode, &reading);
        !watch.conditions.is_empty()
            && !self.recorder.before.mode.satisfies(watch.conditions)
            && self.now.mode.satisfies(watch.conditions)
            && (0..watch.terms.len()).all(|k| value(k) >= 0.0)
    }
}

/// Whether a term is below zero at part `s` of a step. Where it is zero, whatever rounding makes of it, it is on the side from which it
/// comes: the one where it was before, if it was zero all the time.
fn is_below(curve: &[f64], s: f64, resolution: f64, was_below: bool) -> bool {
    let now = value(curve, s);
    if !is_zero(curve, s, now, resolution) {
        return now < 0.0;
    }
    let stays = [0.0, 0.5 * s].map(|s| is_zero(curve, s, value(curve, s), resolution));
    match stays {
        [true, true] => was_below,
        _ => slope(curve, s) > 0.0,
    }
}

/// Whether a curve, `now` at part `s` of a step, is zero there, as far as rounding can tell: of its terms, or of the time, to which the
/// step is resolved to within this part of it.
fn is_zero(curve: &[f64], s: f64, now: f64, resolution: f64) -> bool {
    // Terms of a long step may be large later, and those of a series that has stopped converging are.
    let all: f64 = curve.iter().map(|c| c.abs()).sum();
    let first = curve.iter().take(2).map(|c| c.abs());
    let size = all.min(LATER * (first.sum::<f64>() + now.abs()));
    let steepest = curve.len() as f64 * all;
    if now.abs() > (RESOLUTION * size).max(resolution * steepest) {
        return false;
    }
    // Close to a pole a curve is steep and has no zero: of c/x it is c₀ c₂ = c₁².
    let has_pole = s == 0.0
        && matches!(*curve, [start, rate, bend, ..] if (start * bend).abs() >= 0.5 * rate * rate);
    let steep = if has_pole { 0.0 } else { slope(curve, s).abs() };
    now.abs() <= (RESOLUTION * size).max(resolution * steep)
}

/// The first coefficient that can be told from 0 by numbers this much smaller than all together.
pub(super) fn leading(curve: &[f64], resolution: f64) -> Option<usize> {
    let noise = resolution * curve.iter().map(|c| c.abs()).sum::<f64>();
    curve.iter().position(|c| c.abs() > noise)
}

/// Whether a curve begins above zero, or rises through it within the resolution of time: it may have come there without a step, with the last of
/// impacts that accumulate.
fn begins_true(curve: &[f64], resolution: f64) -> bool {
    match *curve {
        [start, rate, ..] => start >= 0.0 || -start <= resolution * rate,
        [start] => start >= 0.0,
        [] => false,
    }
}

/// Whether a curve begins below zero, or goes there from zero. Nothing if it stays zero, as far as rounding can tell.
fn side_of_start(curve: &[f64], resolution: f64) -> Option<bool> {
    let start = *curve.first()?;
    if !is_zero(curve, 0.0, start, resolution) {
        return Some(start < 0.0);
    }
    let first = leading(&curve[1..], RESOLUTION)?;
    Some(curve[1 + first] < 0.0)
}

/// The part of a step after which a curve that begins with zero, as far as rounding of its values and of the time can tell, can be told from it.
/// Nothing if it does not begin so.
fn zero_at_start(curve: &[f64], resolution: f64) -> Option<f64> {
    let (start, others) = curve.split_first()?;
    if !is_zero(curve, 0.0, *start, resolution) {
        return None;
    }
    let noise = RESOLUTION * curve.iter().map(|c| c.abs()).sum::<f64>();
    let rises = (1..)
        .zip(others)
        .map(|(k, c)| (noise / c.abs()).powf(1.0 / f64::from(k)));
    let risen = rises.fold(1.0, f64::min);
    Some(risen.max(2.0 * resolution))
}

/// Whether a curve begins on the side of zero to which it went before, and crosses it to the other one again.
fn comes_back_at_once(curve: &[f64], was_below: bool) -> bool {
    match (curve, was_below) {
        ([start, rate, ..], true) => *start >= 0.0 && *rate < 0.0,
        ([start, rate, ..], false) => *start <= 0.0 && *rate > 0.0,
        _ => false,
    }
}
