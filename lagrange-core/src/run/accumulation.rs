//! Infinitely many impacts in finite time: a bouncing ball comes to rest.
//!
//! With Newton's restitution the intervals between impacts shrink by a factor ρ < 1, and what is left of them after an
//! interval Δ lasts Δ ρ/(1 − ρ). Once all that can still move in that time is below the tolerance, and not earlier, the
//! contact closes at the limit instant (Brogliato 2016, section 1.3; Goebel & Teel 2008).
//!
//! Of a cycle of several contacts (a rocking block alternates its corners) the impacts of each shrink by a factor; those that
//! take part close together. Impacts of several contacts without a law (a ball in a groove) are followed as one train
//! that gets shorter and shorter.

use super::Run;
use crate::arithmetic::{Scalar, derivatives, rounding};
use crate::error::Error;
use crate::modes::facts::SwitchFacts;
use crate::modes::impact::Impact;
use crate::trajectory::State;

/// Shrinking is believed after this many intervals.
const FEWEST: usize = 3;
/// Intervals that are remembered.
const REMEMBERED: usize = 128;

/// A flight that rises no higher than this, relative to the extent of the gap, is too low for a gap that is rounded at each of its samples.
const LOW: f64 = 1e-9;

/// Rounding of a gap, relative to the terms that make it.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Intervals that shrink by this factor at least shrink to nothing at once: those of a light ball between a heavy one and the floor are squared.
const COLLAPSES: f64 = 0.1;

/// Time intervals below this share of the time itself cannot be told apart.
const RESOLUTION: f64 = 64.0 * f64::EPSILON;

/// The impacts of one contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Impacts<T> {
    /// Number of impacts with shrinking intervals.
    count: usize,
    /// Time of the last one.
    last: f64,
    /// Interval before it.
    interval: f64,
    /// Ratio of the last two intervals.
    ratio: f64,
    /// How long all further ones were to last, as judged at the last one.
    left: f64,
    /// The last three times, the latest first.
    times: [T; 3],
    /// How high the contact opened before the last one.
    height: f64,
    /// How many of the last intervals were below the resolution of time.
    unresolved: usize,
    /// The intervals before the last `REMEMBERED` of the `count` impacts, in a ring.
    intervals: [f64; REMEMBERED],
}

impl<T: Scalar> Default for Impacts<T> {
    fn default() -> Self {
        Impacts {
            count: 0,
            last: 0.0,
            interval: 0.0,
            ratio: 0.0,
            left: f64::INFINITY,
            times: [T::zero(); 3],
            height: f64::INFINITY,
            unresolved: 0,
            intervals: [0.0; REMEMBERED],
        }
    }
}

impl<T: Scalar> Impacts<T> {
    /// Forgets earlier runs; of the ring only what the count covers is ever read.
    pub(super) fn restart(&mut self) {
        (self.count, self.unresolved) = (0, 0);
        (self.last, self.interval, self.ratio) = (0.0, 0.0, 0.0);
        (self.left, self.height) = (f64::INFINITY, f64::INFINITY);
        self.times = [T::zero(); 3];
    }

    /// Books an impact at which the gap closed at this `rate`; returns how long all further ones will last, if they shrink
    /// geometrically, and how uncertain that is.
    fn book(&mut self, time: T, rate: f64) -> Option<(T, f64)> {
        let [last, earlier, _] = self.times;
        self.times = [time, last, earlier];
        let time = time.value();
        let interval = time - self.last;
        let ratio = interval / self.interval;
        let shrinking = self.count > 0 && ratio < 1.0;
        let steady = shrinking && (ratio - self.ratio).abs() < 0.1 * (1.0 - ratio);
        self.count = if shrinking || self.count < 2 {
            self.count + 1
        } else {
            1
        };
        (self.last, self.interval, self.ratio) = (time, interval, ratio);
        self.height = height_of_flight(rate, interval);
        self.intervals[self.count % REMEMBERED] = interval;
        self.unresolved = if interval <= rounding::<T>(RESOLUTION) * time.abs() {
            self.unresolved + 1
        } else {
            0
        };
        if steady && self.count >= FEWEST {
            let ratio = self.mean_ratio();
            let left = interval * ratio / (1.0 - ratio);
            // Judged one impact ago, the same end was as far away and this interval.
            let uncertain = (left + interval - self.left).abs();
            self.left = left;
            return Some((self.with_derivatives(left), uncertain));
        }
        self.left = f64::INFINITY;
        // No law in them, but time no longer tells them apart.
        (self.unresolved >= FEWEST).then_some((T::zero(), 0.0))
    }

    /// Whether the last two intervals shrank to nothing at once.
    pub(super) fn collapses(&self) -> bool {
        self.ratio < COLLAPSES
    }

    /// How long those impacts last that are left after one at this time, if intervals shrink to nothing.
    fn left_of_collapse(&self, time: f64) -> Option<f64> {
        let interval = time - self.last;
        let ratio = interval / self.interval;
        // One short interval may be by chance.
        let collapses = ratio < COLLAPSES && self.collapses();
        (self.count + 1 >= FEWEST && collapses).then_some(interval * ratio)
    }

    /// What is left, with the derivatives that the last impacts give it.
    fn with_derivatives(&self, left: f64) -> T {
        let [time, last, earlier] = self.times;
        let (interval, before) = (time - last, last - earlier);
        let estimate = interval * interval / (before - interval);
        T::from_f64(left) + derivatives(estimate)
    }

    /// Mean ratio of the intervals since they were about e times as long: where they shrink slowly, the resolution of time
    /// blurs the ratio of two by more than its distance from 1 bears.
    fn mean_ratio(&self) -> f64 {
        let back = (1.0 / (1.0 - self.ratio)) as usize;
        // The interval before the first impact of a series is not one of it.
        let back = back.clamp(1, (self.count.saturating_sub(3)).clamp(1, REMEMBERED - 1));
        let earlier = self.intervals[(self.count - back) % REMEMBERED];
        let mean = (self.interval / earlier).powf(1.0 / back as f64);
        if (mean - self.ratio).abs() < 0.1 * (1.0 - self.ratio) {
            mean
        } else {
            self.ratio
        }
    }
}

/// How high a flight rises under a constant force that ends after this interval at this rate.
fn height_of_flight(rate: f64, interval: f64) -> f64 {
    0.25 * rate.abs() * interval
}

/// Impacts in which a train must have become shorter.
const WINDOW: usize = 64;
/// What its second half may last at most, relative to the first.
const SHORTER: f64 = 0.9;
/// What is left of a train is only estimated: it must be below this share of the time itself.
const ESTIMATED: f64 = 1e-9;

/// The impacts of all contacts, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Train {
    count: usize,
    /// Time and contact of the last ones, in a ring.
    hits: [(f64, usize); WINDOW],
    /// See [`Run::is_blurred`], of the last one.
    pub(super) blurred: bool,
}

impl Default for Train {
    fn default() -> Self {
        Train {
            count: 0,
            hits: [(0.0, 0); WINDOW],
            blurred: false,
        }
    }
}

impl Train {
    /// Forgets earlier runs; the ring is only read once it is full.
    pub(super) fn restart(&mut self) {
        self.count = 0;
    }

    fn book(&mut self, time: f64, contact: usize) {
        self.hits[self.count % WINDOW] = (time, contact);
        self.count += 1;
    }

    /// Forgets the impacts of a contact that has come to rest since: those that it has now are of another train.
    fn forget(&mut self, contact: usize) {
        let hits = self.hits;
        let remembered = self.count.saturating_sub(WINDOW)..self.count;
        if remembered.clone().all(|k| hits[k % WINDOW].1 != contact) {
            return;
        }
        self.count = 0;
        for (time, other) in remembered.map(|k| hits[k % WINDOW]) {
            if other != contact {
                self.book(time, other);
            }
        }
    }

    /// When a contact was hit last as one of it.
    fn last(&self, contact: usize) -> Option<f64> {
        let remembered = self.count.saturating_sub(WINDOW)..self.count;
        let mut hits = remembered.rev().map(|k| self.hits[k % WINDOW]);
        hits.find_map(|(time, other)| (other == contact).then_some(time))
    }

    /// Whether there are enough impacts, of several contacts, to judge it.
    fn is_long(&self) -> bool {
        self.count >= WINDOW && self.hits.iter().any(|(_, c)| *c != self.hits[0].1)
    }

    /// How long it will go on, if the second half of the last impacts was shorter than the first.
    fn remaining(&self) -> Option<f64> {
        let ago = |k: usize| self.hits[(self.count + WINDOW - 1 - k) % WINDOW];
        let (now, middle, first) = (ago(0).0, ago(WINDOW / 2).0, ago(WINDOW - 1).0);
        if middle == first {
            return Some(0.0);
        }
        let ratio = (now - middle) / (middle - first);
        (ratio <= SHORTER).then(|| (now - middle) * ratio / (1.0 - ratio))
    }

    /// Whether a contact is one of it: one that is hit at the same instant by chance is not.
    fn has(&self, contact: usize) -> bool {
        let hits = self.hits.iter().filter(|(_, c)| *c == contact);
        hits.count() >= FEWEST
    }
}

impl<T: Scalar> Run<T> {
    /// Ends the infinitely many impacts of contacts that bounce ever less; whether there are any. What they do together is in
    /// [`Collider::rest`](crate::modes::impact::Collider::rest).
    pub(super) fn close_accumulated(
        &mut self,
        outcome: &Impact<T>,
        facts: &mut SwitchFacts,
    ) -> Result<bool, Error> {
        let mut ends = false;
        // A plastic impact after which nothing parts is no bounce; on a rocking block the corner that is hit stays and
        // the other one parts.
        if !facts.parting.contains(&true) {
            return Ok(ends);
        }
        for c in 0..self.description().contacts.len() {
            if !(outcome.struck[c] && facts.arriving[c]) {
                continue;
            }
            if self.switcher.impacts[c].count == 0 && !self.has_hopped(c) {
                self.switcher.train.forget(c);
            }
            self.switcher.train.book(self.now.t.value(), c);
            let ended = self.accumulate(c, outcome, facts);
            if let Some((count, remaining)) = ended.or_else(|| self.die_out(c, outcome, facts)) {
                self.close_contacts(c, (count, remaining), outcome, facts)?;
                ends = true;
            }
        }
        Ok(ends)
    }

    /// Whether contact `c` has opened, since it was hit last as one of the train, no wider than rounding makes of its gap: that it has come to rest in between
    /// means nothing.
    fn has_hopped(&self, c: usize) -> bool {
        let (rate, _) = self.rate(self.description().contacts[c].row);
        let last = self.switcher.train.last(c);
        let height = |last: f64| height_of_flight(rate, self.now.t.value() - last);
        last.is_some_and(|last| height(last) <= self.rounding_of_gap(c))
    }

    /// After an impact of contact `c`: closes it if the impacts to come are below the tolerance. Returns the number of
    /// impacts that led here, and how long the others last.
    fn accumulate(
        &mut self,
        c: usize,
        outcome: &Impact<T>,
        facts: &mut SwitchFacts,
    ) -> Option<(usize, T)> {
        let (rate, _) = self.rate(self.description().contacts[c].row);
        let impacts = &mut self.switcher.impacts[c];
        let (remaining, uncertain) = impacts.book(self.now.t, rate)?;
        // Nothing becomes more certain by bounces that are too low for the gap.
        let certain = self.flew_low(c)
            || uncertain <= self.settings.tolerance * self.now.t.value().abs().max(1.0)
            || remaining.value() <= rounding::<T>(RESOLUTION) * self.now.t.value().abs();
        if !(certain
            && self.is_over_together(c, remaining.value(), outcome)
            && self.ends_undisturbed(c, remaining, outcome, facts))
        {
            return None;
        }
        let mut count = 0;
        for other in 0..self.switcher.impacts.len() {
            if other == c || self.ends_together(other, outcome) {
                count += self.switcher.impacts[other].count;
                self.end(other, facts);
            }
        }
        Some((count, remaining))
    }

    /// Whether a contact takes part in the same cycle as one whose impacts end: by its own law the time that is left to it is over as well.
    pub(super) fn ends_together(&self, c: usize, outcome: &Impact<T>) -> bool {
        let impacts = &self.switcher.impacts[c];
        let left = impacts.last + impacts.left - self.now.t.value();
        impacts.count >= FEWEST && self.is_over_for_gaps(left.abs(), outcome) && self.vanishes(c)
    }

    /// Whether the impacts of contact `c` are over. Where others that are struck with it go on, nothing else may move by more than the tolerance either.
    fn is_over_together(&self, c: usize, remaining: f64, outcome: &Impact<T>) -> bool {
        let mut struck = (0..outcome.struck.len()).filter(|&other| outcome.struck[other]);
        self.is_over(remaining)
            || self.is_over_for_gaps(remaining, outcome)
                && struck.all(|other| other == c || self.ends_together(other, outcome))
    }

    /// The same for contacts that are hit without a law in it.
    fn die_out(
        &mut self,
        c: usize,
        outcome: &Impact<T>,
        facts: &mut SwitchFacts,
    ) -> Option<(usize, T)> {
        if !(self.switcher.train.is_long() && self.switcher.train.has(c)) {
            return None;
        }
        let remaining = match self.switcher.train.remaining() {
            Some(remaining) => remaining,
            None if self.is_unresolved() => 0.0,
            None => return None,
        };
        // A contact that has a law of its own all the same bounces on for as long as that says.
        let lawful = Some(self.switcher.impacts[c].left).filter(|left| left.is_finite());
        let remaining = lawful.map_or(remaining, |left| left.max(remaining));
        // Where rounding hides which contact is hit next, nothing becomes more certain.
        let certain =
            remaining <= ESTIMATED * self.now.t.value().abs() || self.switcher.train.blurred;
        if !(certain && self.is_over_for_gaps(remaining, outcome)) {
            return None;
        }
        let count = self.switcher.train.count;
        for c in 0..self.switcher.impacts.len() {
            if self.switcher.train.has(c) && self.vanishes(c) {
                self.end(c, facts);
            }
        }
        // What only the gaps stay for is over already: nothing else moves meanwhile.
        let remaining = if self.is_over(remaining) {
            remaining
        } else {
            0.0
        };
        self.switcher.train.restart();
        Some((count, T::from_f64(remaining)))
    }

    /// Whether an impact strikes contacts at once that were struck one after the other: rounding may hide which of them is hit first.
    pub(super) fn is_blurred(&self, outcome: &Impact<T>) -> bool {
        let struck = outcome.struck.iter().zip(&self.now.mode.contacts);
        let opened = struck.zip(&self.switcher.impacts);
        let mut opened = opened.filter(|((struck, closed), _)| **struck && !**closed);
        let last = opened.next().map(|(_, impacts)| impacts.last);
        opened.any(|(_, impacts)| Some(impacts.last) != last)
    }

    /// A contact that is hit by the last of impacts which shrink to nothing so fast that rounding hides the next one already, of time or of the gap of
    /// another one that is hit at once. Of all that are left none rebounds.
    pub(super) fn collapsing(&self, outcome: &Impact<T>) -> Option<usize> {
        let opened = |c: &&usize| outcome.struck[**c] && !self.now.mode.contacts[**c];
        let mut struck = self.switcher.near.iter().filter(opened);
        let several = self.switcher.train.blurred;
        let time = self.now.t.value();
        let ends = |c: &&usize| {
            let left = self.switcher.impacts[**c].left_of_collapse(time);
            left.is_some_and(|left| match several {
                true => self.is_over_for_gaps(left, outcome),
                false => left <= rounding::<T>(RESOLUTION) * time.abs(),
            })
        };
        struck.find(ends).copied()
    }

    /// Ends the impacts that collapse with the one of contact `c`, which is solved but has not changed the velocities.
    pub(super) fn close_collapsed(
        &mut self,
        c: usize,
        outcome: &Impact<T>,
        facts: &mut SwitchFacts,
    ) -> Result<(), Error> {
        let count = self.switcher.impacts[c].count + 1;
        for other in 0..outcome.struck.len() {
            if outcome.struck[other] {
                self.end(other, facts);
            }
        }
        self.close_contacts(c, (count, T::zero()), outcome, facts)
    }

    /// Whether all that can move in so much time is below the tolerance.
    fn is_over(&self, remaining: f64) -> bool {
        // Below the resolution of time nothing can be told apart.
        if remaining <= rounding::<T>(RESOLUTION) * self.now.t.value().abs() {
            return true;
        }
        let stays = |(i, (q, v)): (usize, (&T, &T))| {
            v.value().abs() * remaining <= self.settings.allowed(i, q.value().abs())
        };
        let State { q, v, .. } = &self.now.state;
        q.iter().zip(v).enumerate().all(stays)
    }

    /// The same where the last impact is blurred and the gaps alone stay that it strikes.
    fn is_over_for_gaps(&self, remaining: f64, outcome: &Impact<T>) -> bool {
        let d = self.description();
        let mut struck = (0..d.contacts.len()).filter(|&c| outcome.struck[c]);
        let shuts = |c: usize| {
            let (rate, _) = self.rate(d.contacts[c].row);
            rate.abs() * remaining <= self.settings.tolerance * self.locator.polynomials.extents[c]
        };
        self.is_over(remaining) || self.switcher.train.blurred && struck.all(shuts)
    }

    /// Whether contact `c` is between two impacts of a series.
    pub(super) fn bounces(&self, c: usize) -> bool {
        let impacts = &self.switcher.impacts[c];
        impacts.count >= FEWEST && self.now.t.value() - impacts.last <= 2.0 * impacts.interval
    }

    /// Whether a contact is open for a flight so low that samples of its gap do not tell when it ends, while Taylor series do.
    pub(super) fn flies_low(&self) -> bool {
        let extents = &self.locator.polynomials.extents;
        let flown = self.switcher.impacts.iter().zip(extents);
        let contacts = self.now.mode.contacts.iter().zip(flown);
        let mut flights = contacts.filter(|(closed, _)| !**closed);
        flights.any(|(_, (impacts, extent))| {
            let lasts = self.now.t.value() - impacts.last;
            impacts.height <= LOW * extent && lasts <= 2.0 * impacts.interval
        })
    }

    /// Whether no gap of the train has opened wider, before the last impact there, than rounding makes of it: such impacts never end.
    fn is_unresolved(&self) -> bool {
        let mut train = (0..self.switcher.impacts.len()).filter(|&c| self.switcher.train.has(c));
        train.all(|c| self.flew_low(c))
    }

    /// Whether contact `c` has opened no wider, before its last impact, than rounding makes of its gap.
    pub(super) fn flew_low(&self, c: usize) -> bool {
        self.switcher.impacts[c].height <= self.rounding_of_gap(c)
    }

    /// What rounding makes of the gap of contact `c`.
    pub(super) fn rounding_of_gap(&self, c: usize) -> f64 {
        rounding::<T>(ROUNDING) * self.size_of_gap(c)
    }

    /// The size of the terms that make the gap of contact `c`.
    pub(super) fn size_of_gap(&self, c: usize) -> f64 {
        let row = self.description().contacts[c].row;
        let size = |j: usize| self.now.state.q[j].value().abs();
        self.dynamics.size_of_row(row, size)
    }

    /// Whether the gap of contact `c` is below the tolerance.
    fn vanishes(&self, c: usize) -> bool {
        let extent = self.locator.polynomials.extents[c];
        self.gap(c).abs() <= self.settings.tolerance * extent
    }

    /// Contact `c` bounces no more.
    pub(super) fn end(&mut self, c: usize, facts: &mut SwitchFacts) {
        (facts.touching[c], facts.parting[c]) = (true, false);
        // How high it flew last tells of a train that it is one of.
        let height = self.switcher.impacts[c].height;
        self.switcher.impacts[c] = Impacts {
            height,
            ..Impacts::default()
        };
    }
}
