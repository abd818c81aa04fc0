//! Contacts that touch beside those that have closed: their gaps vanish, or are what rounding has left.

use super::Run;
use crate::arithmetic::{Scalar, epsilon, rounding};
use crate::effects::Item;
use crate::integrate::horner;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::Guard;

/// A body that is closed at some points may be off by so many times more at others.
pub(super) const LEVER: f64 = 4.0;

/// A gap that comes back to zero after some steps is off by so many times what rounding makes of it at one instant,
const DRIFT: f64 = 50.0;
/// and by no more than it closes by in this share of the time: one that closes as slowly as it is small closes later.
const INSTANT: f64 = 1e-12;

/// Instants are known to so many units of the rounding of time.
pub(super) const UNITS_OF_TIME: f64 = 8.0;

/// What is no larger than this beside the terms that make it is what rounding has left of zero.
pub(super) const ROUNDING: f64 = 1e-13;

impl<T: Scalar> Run<T> {
    /// Contacts that have closed may bring others with them: a beam on two of its four supports lies on all. What comes to the edge of a surface may touch
    /// another there: a wheel rolls about the edge of a table. Their gaps and rates vanish, and nothing but rounding would tell later which of them closes when. What an impact has thrown off is among them where the impacts
    /// of the others end with it.
    pub(super) fn take_what_touches(&mut self, facts: &mut SwitchFacts) {
        let d = self.description();
        let contacts = 0..d.contacts.len();
        if !contacts.clone().any(|c| self.may_touch(c, facts)) {
            return;
        }
        self.tape_of_all_rows();
        self.now.valued = false;
        let off = self.largest_gap(|c| facts.touching[c]);
        let lies = facts.touching.contains(&true);
        for c in contacts {
            // The last flights of a body that bounces are lower than what a body lies with may be off.
            let nothing = match self.bounces(c) && !lies {
                true => self.rounding_of_gap(c),
                false => rounding::<T>(ROUNDING) * self.extent(c) + off,
            };
            if self.may_touch(c, facts) && self.touches(c, nothing) {
                self.end(c, facts);
                for f in d.frictions_on(c) {
                    facts.resting[f] = self.slip_vanishes(f);
                }
            }
        }
    }

    /// Gaps that rounding has closed a little after something else has ended the mode close with it: of a box that falls flat into a corner, two corners
    /// strike at the instant at which a third one has ceased to slide.
    pub(super) fn strike_with_what_falls(&mut self, facts: &mut SwitchFacts) {
        let contacts = 0..self.description().contacts.len();
        if facts.arriving.contains(&true) || !contacts.clone().any(|c| self.nears(c, facts)) {
            return;
        }
        self.tape_of_all_rows();
        self.now.valued = false;
        let off = self.largest_gap(|c| facts.touching[c]);
        for c in contacts {
            if self.nears(c, facts) && self.is_within_rounding(c, off) && self.approaching(c) {
                (facts.touching[c], facts.arriving[c]) = (true, true);
                facts.located.push(Guard::Gap(c));
            }
        }
    }

    /// Whether contact `c` may touch, as far as the polynomial of its gap says.
    fn nears(&self, c: usize, facts: &SwitchFacts) -> bool {
        let polynomials = &self.locator.polynomials;
        self.may_touch(c, facts)
            && polynomials.of(Guard::Gap(c)).is_some_and(|curve| {
                horner(curve, self.part_of_step()).abs()
                    <= self.settings.tolerance * polynomials.extents[c]
            })
    }

    /// The part of the last step at which the motion is now.
    fn part_of_step(&self) -> f64 {
        let step = &self.stepper.step;
        (self.now.t.value() - step.t.value()) / step.h.value()
    }

    /// How far the gaps of these contacts are off zero, at which they are known to be.
    pub(super) fn largest_gap(&self, closed: impl Fn(usize) -> bool) -> f64 {
        let closed = (0..self.description().contacts.len()).filter(|&c| closed(c));
        closed.map(|c| self.gap(c).abs()).fold(0.0, f64::max)
    }

    /// The gap of contact `c`.
    pub(super) fn gap(&self, c: usize) -> f64 {
        let d = self.description();
        let place = d.rows[d.contacts[c].row].position;
        place.map_or(0.0, |place| self.dynamics.motion(place).value())
    }

    /// Whether contact `c` may touch: it takes part, and it is not known to touch, to be below its surface or to be at the edge of it.
    pub(super) fn may_touch(&self, c: usize, facts: &SwitchFacts) -> bool {
        let takes_part = self
            .dynamics
            .effects()
            .includes(self.description(), Item::Contact(c));
        let is_at_edge = facts.located.contains(&Guard::Region(c));
        takes_part && !(facts.touching[c] || self.now.below[c] || is_at_edge)
    }

    /// Whether rounding explains the gap of contact `c`, or what the run has left of the gaps that vanish, which are `off` by so much: a table that
    /// falls back from two of its feet lands on the others at once.
    pub(super) fn is_within_rounding(&self, c: usize, off: f64) -> bool {
        let (gap, rounding) = (self.gap(c).abs(), self.rounding_of_gap(c));
        let (rate, _) = self.rate(self.description().contacts[c].row);
        let closes = -rate * INSTANT * self.now.t.value().abs().max(1.0);
        let drifts = (DRIFT * rounding).min(closes);
        self.is_in_region(c) && gap <= rounding.max(LEVER * off).max(drifts)
    }

    /// Whether the gap of contact `c` is `nothing`, and its rate vanishes beside the terms that make it.
    fn touches(&self, c: usize, nothing: f64) -> bool {
        let contact = &self.description().contacts[c];
        let (rate, size) = self.rate(contact.row);
        self.is_in_region(c)
            && self.gap(c).abs() <= nothing
            && (rate.abs() <= rounding::<T>(ROUNDING) * size
                || rate.abs() <= self.rounding_of_time_in_rate(c))
    }

    /// What the resolution of time makes of the rate of the gap of contact `c`, by what its polynomial bent in the last step.
    fn rounding_of_time_in_rate(&self, c: usize) -> f64 {
        let curve = self.locator.polynomials.of(Guard::Gap(c));
        let terms = curve.unwrap_or_default().iter().enumerate().skip(2);
        let (now, h) = (self.now.t.value(), self.stepper.step.h.value());
        let end = self.part_of_step();
        let bends = terms.map(|(k, c)| (k * (k - 1)) as f64 * c * end.powi(k as i32 - 2));
        UNITS_OF_TIME * epsilon::<T>() * now.abs() * bends.sum::<f64>().abs() / (h * h)
    }

    /// What the gap of contact `c` changes by when each coordinate x changes by 1, or |x| if that is more; `dynamics` holds the numbers of its row.
    pub(super) fn extent(&self, c: usize) -> f64 {
        let row = self.description().contacts[c].row;
        let size = |j: usize| self.now.state.q[j].value().abs().max(1.0);
        self.dynamics.size_of_row(row, size)
    }

    /// Takes down how large the gaps are; `dynamics` holds the numbers of all rows.
    pub(super) fn measure_gaps(&mut self) {
        for c in 0..self.description().contacts.len() {
            let extent = self.extent(c);
            self.locator.polynomials.extents[c] = extent.max(1.0);
        }
    }
}
