//! What ends a step early: the earliest root among the guards of the mode and the stops.

use super::Run;
use super::guard_polynomials::{CLEAR, GuardPolynomials};
use super::hit::Hit;
use super::region::is_edge_in_flight;
use super::spatial_slip::Rest;
use super::still::StillWatches;
use super::watches::{RESOLUTION, leading};
use crate::arithmetic::{Scalar, epsilon};
use crate::events::{Direction, deflate, find_root_until};
use crate::integrate::{polynomial_derivative as slope, polynomial_value as value};
use crate::mode::Mode;
use crate::modes::composite::CompositeGuard;
use crate::modes::guard::{Guard, LENGTH};
use crate::settings::Settings;
use crate::system::{Description, Watch};
use core::ops::ControlFlow::{Break, Continue};

/// Residues move a root by less than this share of its time; else they are what the guard is.
const RESIDUE: f64 = 1e-3;

/// What finds the first thing that happens in a step, and what it knows of steps before.
#[derive(Debug)]
pub(super) struct Locator<T> {
    pub(super) polynomials: GuardPolynomials,
    /// Guards whose leading coefficients vanish at the start of the coming step.
    pub(super) zeros: Vec<(Guard, usize)>,
    /// Contacts whose region the motion enters at this instant, on the surface.
    pub(super) entered: Vec<usize>,
    /// Per contact: another one that keeps the motion at the edge of its region as long as it is closed.
    pub(super) edges_held: Vec<Option<usize>>,
    /// Whether a gap began at zero with the step that has just ended.
    pub(super) opened: bool,
    /// Whether a gap stays zero although its contact is open, because others hold it there.
    pub(super) lies: bool,
    /// Forces that are at their limit, with their sizes.
    pub(super) at_limit: Vec<(Guard, f64)>,
    /// Relative error of these forces, from the directions of slips that have nearly vanished.
    pub(super) blur: f64,
    /// Falling guards found in the present step: (guard, part of the step, half width).
    falls: Vec<(Guard, f64, f64)>,
    pub(super) fallen: Vec<Guard>,
    /// Contacts by which the motion passes at the end of the present step: it comes to their surface and leaves their region at once.
    pub(super) passing: Vec<usize>,
    /// Composite guards that seemed to fall in the present step where forces keep all bounds.
    pub(super) refuted: Vec<CompositeGuard>,
    /// Slips of two components that come to rest with the end of the step.
    pub(super) rests: Vec<Rest>,
    /// The mode in which these slips are at rest.
    pub(super) resting: Mode,
    /// Slips of two components at the start of a step.
    pub(super) slips: Vec<(usize, [f64; 2])>,
    /// Velocities a little before they come to rest.
    pub(super) earlier: Vec<T>,
    /// Per stop, which of its terms are below zero.
    pub(super) stop_below: Vec<Vec<bool>>,
    /// Per mark, which of its terms are below zero.
    pub(super) mark_below: Vec<Vec<bool>>,
    /// Per mark, its term that passed zero at the end of the last step.
    pub(super) mark_passed: Vec<Option<usize>>,
    /// Per mark, when it was passed last.
    pub(super) mark_times: Vec<f64>,
    pub(super) marks: Vec<(usize, f64)>,
    /// Terms of stops and marks that vanish where guards fall at the end of the present step, with the size up to which they count as zero there.
    pub(super) vanishing: Vec<(Guard, f64)>,
    /// Terms of stops and marks that rounding alone changes.
    pub(super) still: StillWatches,
}

/// Within this part of the step guards are looked at once more.
const EARLY: f64 = 0.1;

impl<T: Scalar> Locator<T> {
    pub(super) fn new(d: &Description, settings: &Settings, mode: &Mode) -> Self {
        let nowhere = |watches: &[Watch]| {
            let terms = watches.iter().map(|watch| watch.terms.len());
            terms.map(|terms| vec![false; terms]).collect()
        };
        Locator {
            polynomials: GuardPolynomials::new(d, &settings.effects),
            zeros: Vec::new(),
            entered: Vec::new(),
            edges_held: vec![None; d.contacts.len()],
            opened: false,
            lies: false,
            at_limit: Vec::new(),
            blur: 0.0,
            falls: Vec::new(),
            fallen: Vec::new(),
            passing: Vec::new(),
            refuted: Vec::new(),
            rests: Vec::new(),
            resting: mode.clone(),
            slips: Vec::with_capacity(d.frictions.len()),
            earlier: vec![T::default(); d.coordinates.len()],
            stop_below: nowhere(d.stops),
            mark_below: nowhere(d.marks),
            mark_passed: vec![None; d.marks.len()],
            mark_times: vec![f64::NEG_INFINITY; d.marks.len()],
            marks: Vec::new(),
            vanishing: Vec::new(),
            still: StillWatches::new(),
        }
    }

    /// Forgets what belongs to another motion.
    pub(super) fn restart(&mut self) {
        let Self {
            polynomials,
            zeros,
            entered,
            edges_held,
            opened,
            lies,
            at_limit,
            blur,
            falls,
            fallen,
            passing,
            refuted,
            rests,
            resting: _,
            slips,
            earlier: _,
            stop_below,
            mark_below,
            mark_passed,
            mark_times,
            marks,
            vanishing,
            still,
        } = self;
        polynomials.restart();
        zeros.clear();
        entered.clear();
        edges_held.fill(None);
        (*opened, *lies, *blur) = (false, false, 0.0);
        at_limit.clear();
        falls.clear();
        fallen.clear();
        passing.clear();
        refuted.clear();
        rests.clear();
        slips.clear();
        let watches = stop_below.iter_mut().chain(mark_below);
        watches.for_each(|terms| terms.fill(false));
        mark_passed.fill(None);
        mark_times.fill(f64::NEG_INFINITY);
        marks.clear();
        vanishing.clear();
        still.restart();
    }

    /// Whether the end of a step is the root of a guard, and how large what makes it is at least: of a force at its limit nothing else is left.
    pub(super) fn known(&self, hit: &Hit) -> impl Fn(Guard) -> (bool, f64) {
        let stops = matches!(hit, Hit::Stop(..));
        let Locator {
            fallen, at_limit, ..
        } = self;
        move |guard| {
            let located = fallen.contains(&guard) || stops && matches!(guard, Guard::Stop(..));
            let held = at_limit.iter().find(|(other, _)| *other == guard);
            (located, held.map_or(0.0, |(_, size)| *size))
        }
    }
}

impl<T: Scalar> Run<T> {
    /// Whether nothing can happen within the step because all guards, stops and marks keep their sign by far: a bound that most
    /// steps satisfy.
    #[inline(never)]
    pub(super) fn nothing_happens(&mut self) -> bool {
        let mode = &self.now.mode;
        let matters = |guard| !is_edge_in_flight(guard, mode);
        let guards_stay = self.locator.polynomials.look(&self.locator.zeros, matters);
        let d = self.description();
        let stays = |&i: &usize| {
            let below = &self.locator.stop_below[i];
            let mut terms = below.iter().enumerate();
            !self.now.mode.satisfies(d.stops[i].conditions)
                || terms.all(|(k, &below)| self.locator.polynomials.stop_stays(i, k, below))
        };
        guards_stay && self.locator.polynomials.stops.iter().all(stays)
    }

    /// Finds what happens first within the step.
    pub(super) fn first_hit(&mut self) -> Hit {
        self.note_edges_ahead();
        let mut first = self.list_falls(1.0);
        let of_series = !self.locator.polynomials.are_sharpened();
        if of_series && first > 0.0 && first < EARLY {
            // Taylor coefficients of a step that goes on far beyond may be so large that their rounding hides what is earlier still.
            first = self.list_falls(2.0 * first);
        }
        // Roots whose enclosures overlap with that of the earliest cannot be told apart from it, nor can those at a
        // distance that time does not resolve.
        let h = self.stepper.step.h.value();
        first += 8.0 * epsilon::<T>() * (self.now.t.value() / h).abs().max(1.0);
        self.locator.fallen.clear();
        let mut at = f64::INFINITY;
        for &(guard, s, width) in &self.locator.falls {
            if s - width <= first {
                self.locator.fallen.push(guard);
                at = at.min(s);
            }
        }
        self.meet_edges(at);
        self.hit_at_edge(at);
        let guards = if self.locator.fallen.is_empty() {
            self.locator.rests.clear();
            Hit::Nothing
        } else {
            self.tell_rest_from_turn(at);
            self.tell_reversal_from_decay(at);
            if self.locator.fallen.is_empty() {
                Hit::Turned(at)
            } else {
                Hit::Guards(at)
            }
        };
        // A stop at the instant of an impact ends the run before it; rounding may see it a little later.
        let until = (guards.end() * (1.0 + 1e-13)).min(1.0);
        let mut stop = self.first_stop(until);
        if let Some((_, s)) = stop
            && self.look_for_still_watches(s)
        {
            stop = self.first_stop(until);
        }
        match stop {
            Some((stop, s)) => Hit::Stop(stop, s),
            None => guards,
        }
    }

    /// Lists where guards of the mode fall up to part `until` of the step. The end of the first enclosure.
    fn list_falls(&mut self, until: f64) -> f64 {
        let mut falls = core::mem::take(&mut self.locator.falls);
        falls.clear();
        let mut first = f64::INFINITY;
        for (guard, curve) in self.locator.polynomials.in_question() {
            if let Some((s, width)) = self.fall(guard, curve, until) {
                falls.push((guard, s, width));
                first = first.min(s + width);
            }
        }
        self.locator.falls = falls;
        first
    }

    /// Where a guard of the mode falls through zero up to part `until` of the step: (part of the step, half width of the enclosure).
    fn fall(&self, guard: Guard, curve: &[f64], until: f64) -> Option<(f64, f64)> {
        if self.stays_at_edge(guard, curve) {
            return None;
        }
        if is_edge_in_flight(guard, &self.now.mode) {
            return self.comes_onto(guard, curve);
        }
        if let Guard::Composite(k) = guard
            && let Some(after) = self.locator.polynomials.composites[k].falls_after
        {
            let s = after / self.stepper.step.h.value();
            return (s <= 1.0).then_some((s, 2.0 * f64::EPSILON * s));
        }
        let whole = curve;
        let curve = self.judged(guard, whole)?;
        if falls_at_once(curve)
            && !self.is_held_at(guard, 0.0)
            && !self.is_below(guard)
            && self.within_region(guard, 0.0)
        {
            return Some((0.0, 0.0));
        }
        let happens = |s: f64| !self.is_held_at(guard, s) && self.within_region(guard, s);
        let mut latest = 0.0;
        let root = find_root_until(curve, until, |root| {
            let falls = root.direction == Direction::Falling && !root.grazing;
            let (s, width) = self.place(guard, &root);
            latest = s;
            match falls && happens(s) {
                true => Break((s, width)),
                false => Continue(()),
            }
        });
        let falls_last = || {
            let at_end = self.locator.polynomials.end_of(guard)?;
            let passes = self.passes_last(guard, until, curve, at_end, latest);
            (passes && slope(curve, 1.0) < 0.0 && happens(1.0)).then_some((1.0, 0.0))
        };
        let (s, width) = root.or_else(falls_last)?;
        Some((self.with_residues(guard, whole, s), width))
    }

    /// How many leading coefficients of a guard are known to vanish.
    fn known_zeros(&self, guard: Guard) -> usize {
        let zeros = self.locator.zeros.iter().find(|(g, _)| *g == guard);
        zeros.map_or(0, |(_, order)| *order)
    }

    /// The root `s` of a guard that was judged without its first coefficients, where all of them count: a residue of the rate or the force with which
    /// its mode began has added up since.
    fn with_residues(&self, guard: Guard, curve: &[f64], s: f64) -> f64 {
        if self.known_zeros(guard) < 2 {
            return s;
        }
        let by = value(curve, s) / slope(curve, s);
        let counted = s - by;
        match by.abs() <= RESIDUE * s && counted <= 1.0 {
            true => counted,
            false => s,
        }
    }

    /// What of a guard's curve is judged: without leading coefficients that are known to vanish. Nothing if all do.
    pub(super) fn judged<'c>(&self, guard: Guard, curve: &'c [f64]) -> Option<&'c [f64]> {
        let known = self.known_zeros(guard);
        if known >= LENGTH {
            return None;
        }
        if let Some((_, size)) = self.locator.at_limit.iter().find(|(g, _)| *g == guard) {
            // At its limit a force begins at zero, whatever rounding makes of it. Of an interpolation rounding is in the coefficients, which are
            // large and cancel, rather than in the values.
            let clear = CLEAR.max(self.locator.blur) * size;
            let leaves = |place: u32| value(curve, f64::from(place) / 8.0).abs() > clear;
            return (1..=8).any(leaves).then(|| deflate(curve, 1));
        }
        if let Guard::Composite(_) = guard
            && curve.iter().map(|c| c.abs()).sum::<f64>() <= CLEAR
        {
            // It is relative to what makes it: that of a friction whose coefficient is 0 is always rounding.
            return None;
        }
        let judged = deflate(curve, known);
        if let (0, [start, others @ ..]) = (known, judged)
            && *start < 0.0
            && let Some(first) = rises_with(others)
        {
            // A root that rounding has moved across the border between two steps, or a gap that parts from where it was
            // located, shows as a negative start from which the guard rises.
            let size: f64 = judged.iter().map(|c| c.abs()).sum();
            let blur = match guard {
                Guard::Gap(_) => self.settings.tolerance.max(1e-13) * size.max(1.0),
                // It is relative to what makes it.
                Guard::Composite(_) => 1e-13 * size.max(1.0),
                _ => 1e-13 * size,
            };
            if *start > -blur {
                return Some(deflate(judged, 1 + first));
            }
        }
        Some(judged)
    }

    /// Whether the step is so long that rounding hides how a guard begins that falls in it.
    pub(super) fn hides_a_start(&self) -> bool {
        self.locator
            .polynomials
            .in_question()
            .any(|(guard, curve)| {
                if is_edge_in_flight(guard, &self.now.mode) || !self.within_region(guard, 0.0) {
                    return false;
                }
                let curve = self.judged(guard, curve);
                curve.is_some_and(|curve| hides_its_start(guard, curve))
            })
    }
}

/// The coefficient beyond the start with which a guard rises from there: the rate, or the first that is more than rounding. Nothing if it falls.
fn rises_with(others: &[f64]) -> Option<usize> {
    match others.first() {
        Some(rate) if *rate > 0.0 => Some(0),
        _ => leading(others, RESOLUTION).filter(|&first| others[first] > 0.0),
    }
}

/// Whether a guard is negative from the start on, as far as rounding can tell.
fn falls_at_once(curve: &[f64]) -> bool {
    curve.first().is_none_or(|start| *start < 0.0)
        || leading(curve, RESOLUTION).is_some_and(|k| k > 0 && curve[k] < 0.0)
}

/// Whether a guard that begins positive seems to fall at once, or to begin with one of its last coefficients, because these
/// are so much larger over the whole step.
fn hides_its_start(guard: Guard, curve: &[f64]) -> bool {
    // A gap is a position: its first derivatives are not small unless the step is far too long.
    let late = match guard {
        Guard::Gap(_) => 3,
        _ => curve.len() / 2,
    };
    let Some(begin) = curve.iter().position(|c| *c != 0.0) else {
        return false;
    };
    let clear = leading(curve, CLEAR).unwrap_or(begin);
    let falls = curve[begin..=clear.max(begin)].iter().any(|c| *c < 0.0);
    curve[begin] > 0.0 && clear > begin && (falls || clear >= late)
}
