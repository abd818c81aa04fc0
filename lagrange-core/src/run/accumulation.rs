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
use crate::effects::Item;
use crate::error::Error;
use crate::mode::FrictionMode;
use crate::modes::facts::SwitchFacts;
use crate::modes::impact::Impact;
use crate::trajectory::{EventKind, State, Subject};

/// Shrinking is believed after this many intervals.
const FEWEST: usize = 3;
/// Intervals that are remembered.
const REMEMBERED: usize = 128;

/// A flight that rises no higher than this, relative to the extent of the gap, is too low for a gap that is rounded at each of its samples.
const LOW: f64 = 1e-9;

/// Rounding of a gap, relative to the terms that make it.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

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
        // Under a constant force.
        self.height = 0.25 * rate.abs() * interval;
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
}

impl Default for Train {
    fn default() -> Self {
        Train {
            count: 0,
            hits: [(0.0, 0); WINDOW],
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
            self.switcher.train.book(self.now.t.value(), c);
            let ended = self.accumulate(c, facts);
            if let Some((count, remaining)) = ended.or_else(|| self.die_out(c, facts)) {
                let time = self.now.t;
                self.switcher.before_holding.clone_from(&self.now.state);
                let closed = self.close_contacts(c, count, remaining, outcome, facts);
                if closed.is_err() {
                    // A motion that cannot go on ends where it was.
                    self.now.t = time;
                    self.now.state.clone_from(&self.switcher.before_holding);
                }
                closed?;
                ends = true;
            }
        }
        Ok(ends)
    }

    /// After an impact of contact `c`: closes it if the impacts to come are below the tolerance. Returns the number of
    /// impacts that led here, and how long the others last.
    fn accumulate(&mut self, c: usize, facts: &mut SwitchFacts) -> Option<(usize, T)> {
        let (rate, _) = self.rate(self.description().contacts[c].row);
        let impacts = &mut self.switcher.impacts[c];
        let (remaining, uncertain) = impacts.book(self.now.t, rate)?;
        let height = impacts.height;
        // Nothing becomes more certain by bounces that are too low for the gap.
        let certain = height <= self.rounding_of_gap(c)
            || uncertain <= self.settings.tolerance * self.now.t.value().abs().max(1.0)
            || remaining.value() <= rounding::<T>(RESOLUTION) * self.now.t.value().abs();
        if !(certain && self.is_over(remaining.value())) {
            return None;
        }
        // Contacts that take part in the same cycle close with it: by their own law the time that is left to them is over as well.
        let mut count = 0;
        for other in 0..self.switcher.impacts.len() {
            let impacts = &self.switcher.impacts[other];
            let left = impacts.last + impacts.left - self.now.t.value();
            let together = impacts.count >= FEWEST && self.is_over(left.abs());
            if other == c || together && self.vanishes(other) {
                count += impacts.count;
                self.end(other, facts);
            }
        }
        Some((count, remaining))
    }

    /// The same for contacts that are hit without a law in it.
    fn die_out(&mut self, c: usize, facts: &mut SwitchFacts) -> Option<(usize, T)> {
        if !(self.switcher.train.is_long() && self.switcher.train.has(c)) {
            return None;
        }
        let remaining = match self.switcher.train.remaining() {
            Some(remaining) => remaining,
            None if self.is_unresolved() => 0.0,
            None => return None,
        };
        if remaining > ESTIMATED * self.now.t.value().abs() || !self.is_over(remaining) {
            return None;
        }
        for c in 0..self.switcher.impacts.len() {
            if self.switcher.train.has(c) && self.vanishes(c) {
                self.end(c, facts);
            }
        }
        let count = self.switcher.train.count;
        self.switcher.train.restart();
        Some((count, T::from_f64(remaining)))
    }

    /// Whether all that can move in so much time is below the tolerance.
    fn is_over(&self, remaining: f64) -> bool {
        let moves = |(i, (q, v)): (usize, (&T, &T))| {
            v.value().abs() * remaining > self.settings.allowed(i, q.value().abs())
        };
        let State { q, v, .. } = &self.now.state;
        // Below the resolution of time nothing can be told apart.
        let resolved = remaining > rounding::<T>(RESOLUTION) * self.now.t.value().abs();
        !(resolved && q.iter().zip(v).enumerate().any(moves))
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
        let impacts = self.switcher.impacts.iter().enumerate();
        let mut train = impacts.filter(|(c, _)| self.switcher.train.has(*c));
        train.all(|(c, impacts)| impacts.height <= self.rounding_of_gap(c))
    }

    /// What rounding makes of the gap of contact `c`.
    pub(super) fn rounding_of_gap(&self, c: usize) -> f64 {
        let row = self.description().contacts[c].row;
        let size = |j: usize| self.now.state.q[j].value().abs();
        rounding::<T>(ROUNDING) * self.dynamics.size_of_row(row, size)
    }

    /// Whether the gap of contact `c` is below the tolerance.
    fn vanishes(&self, c: usize) -> bool {
        let extent = self.locator.polynomials.extents[c];
        self.gap(c).abs() <= self.settings.tolerance * extent
    }

    /// Contact `c` bounces no more.
    pub(super) fn end(&mut self, c: usize, facts: &mut SwitchFacts) {
        (facts.touching[c], facts.parting[c]) = (true, false);
        self.switcher.impacts[c] = Impacts::default();
    }

    /// Moves the state by a flight so short that the accelerations at hand do not change.
    fn fly(&mut self, lasts: T) {
        let half = T::from_f64(0.5) * lasts;
        let State { q, v, .. } = &mut self.now.state;
        let motion = self.dynamics.acceleration().iter();
        for ((q, v), &acceleration) in q.iter_mut().zip(v).zip(motion) {
            let change = lasts * acceleration;
            *q += lasts * *v + half * change;
            *v += change;
        }
        self.now.t += lasts;
    }

    /// How long such a flight has been beyond the surfaces of other contacts than those that are `near`: impacts with one side of a groove end where the
    /// other one begins.
    fn time_beyond(&self, near: &[usize]) -> T {
        let d = self.description();
        let others = (0..d.contacts.len()).filter(|&c| {
            let takes_part = self.dynamics.effects().includes(d, Item::Contact(c));
            let open = !(near.contains(&c) || self.now.below[c]);
            takes_part && open && self.is_in_region(c)
        });
        let since = |c: usize| {
            let row = &d.rows[d.contacts[c].row];
            let gap = row
                .position
                .map_or(T::zero(), |place| self.dynamics.motion(place));
            let (rate, _) = self.rate(d.contacts[c].row);
            let beyond = gap.value() < 0.0 && rate < 0.0;
            if beyond {
                gap / T::from_f64(rate)
            } else {
                T::zero()
            }
        };
        others.map(since).fold(T::zero(), |most, since| {
            if since.value() > most.value() {
                since
            } else {
                most
            }
        })
    }

    /// Makes all impacts that are left in the time `remaining`, and logs it.
    ///
    /// Together they do what a flight of that length does, and an impact without restitution at its end: momentum does not see
    /// how impulses are distributed, and neither does friction that slips all the while.
    fn close_contacts(
        &mut self,
        c: usize,
        count: usize,
        mut remaining: T,
        outcome: &Impact<T>,
        facts: &mut SwitchFacts,
    ) -> Result<(), Error> {
        let d = self.description();
        let mut near = core::mem::take(&mut self.switcher.near);
        near.clear();
        near.extend((0..d.contacts.len()).filter(|&c| facts.touching[c]));
        let mode = &mut self.switcher.scratch_mode;
        mode.clone_from(&self.now.mode);
        // What lies where nothing strikes goes on as it did.
        for &c in near.iter().filter(|&&c| outcome.struck[c]) {
            mode.contacts[c] = false;
            d.frictions_on(c)
                .for_each(|f| mode.frictions[f] = FrictionMode::Inactive);
        }
        self.dynamics.set_mode(&self.switcher.scratch_mode);
        self.evaluate_all_rows()?;
        self.fly(remaining);
        self.evaluate_all_rows()?;
        let beyond = self.time_beyond(&near);
        if beyond.value() > 0.0 && beyond.value() <= remaining.value() {
            self.fly(-beyond);
            self.evaluate_all_rows()?;
            remaining -= beyond;
        }
        let time = self.now.t.value();
        (self.switcher.collider).bring_to_rest(&self.dynamics, time, &self.now.state.v, &near)?;
        let rest = core::mem::take(&mut self.switcher.collider.rest);
        let half = T::from_f64(0.5) * remaining;
        let State { q, v, .. } = &mut self.now.state;
        for ((q, v), &after) in q.iter_mut().zip(v).zip(&rest.v) {
            *q += half * (after - *v);
            *v = after;
        }
        near.iter()
            .for_each(|&c| self.switcher.scratch_mode.contacts[c] = true);
        // What comes to rest here does so together with what it lifts.
        let rubbing = near.iter().flat_map(|&c| d.frictions_on(c));
        rubbing.filter(|&f| rest.sticks[f]).for_each(|f| {
            self.switcher.scratch_mode.frictions[f] = FrictionMode::Stick;
        });
        self.dynamics.set_mode(&self.switcher.scratch_mode);
        self.project(true)?;
        self.evaluate_all_rows()?;
        for (f, friction) in d.frictions.iter().enumerate() {
            // A friction with a force of its own has slipped at the last impact and sticks again before the next one.
            if friction.normal.presses(|c| near.contains(&c)) {
                facts.resting[f] = rest.sticks[f] || self.slip_vanishes(f);
            }
        }
        (self.switcher.near, self.switcher.collider.rest) = (near, rest);
        // The mode is still that of the flights, and so are the forces; what changes with the last one does so from here.
        self.dynamics.set_mode(&self.now.mode);
        self.evaluate_all_rows()?;
        let kind = EventKind::Accumulates { impacts: count };
        self.log_here(Subject::Contact(c), kind);
        self.remember_before();
        Ok(())
    }
}
