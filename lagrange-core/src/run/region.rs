//! Contacts limited to a region: `contact(table: y >= 0, where x <= length)`.
//!
//! Such a contact exists only where its region ≥ 0. A closed one whose region falls through zero opens, and its frictions end.
//! The surface has one side: a gap that closes within the region is an impact, one that closes outside it is not, and then the
//! motion is below the surface, until the gap has opened again, wherever that is. Below it may enter the region freely, and
//! come up through it. Where it enters the region on the surface, as a wheel that climbs a kerb, the contact closes.

use super::Run;
use crate::arithmetic::{Scalar, rounding};
use crate::effects::Item;
use crate::events::{Direction, find_root};
use crate::integrate::{polynomial_derivative as slope, polynomial_value as value};
use crate::mode::Mode;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::Guard;
use crate::system::{Contact, ValueRef};
use crate::trajectory::State;
use core::ops::ControlFlow::Break;

/// Gaps that other gaps hold at zero are off by no more than this, relative to what makes them.
const ROUNDING: f64 = 1e-12;

/// What closes by no more than this share of its terms over a step does not hit where a surface ends, but touches.
const HITS: f64 = 1e-6;

/// Roots are located to this share of what a guard changes by in a step.
const LOCATED: f64 = 1e-9;

/// Whether the motion goes out at an edge is seen over this share of its extent, and where it goes out by no more than this share of that again it does not.
const SOON: f64 = 1e-6;

/// Positions of a step are rounded to this, relative to how far it reaches.
const OF_STEP: f64 = 64.0 * f64::EPSILON;

/// At so many parts of a step it is seen whether it stays at an edge.
const PLACES: usize = 8;

/// Whether a guard is the edge of a contact that is open in a mode.
pub(super) fn is_edge_in_flight(guard: Guard, mode: &Mode) -> bool {
    matches!(guard, Guard::Region(c) if !mode.contacts[c])
}

impl<T: Scalar> Run<T> {
    /// Whether a guard is the gap of a contact whose surface the motion is below.
    pub(super) fn is_below(&self, guard: Guard) -> bool {
        matches!(guard, Guard::Gap(c) if self.now.below[c])
    }

    /// Whether the present state is in the region of contact `c`.
    pub(super) fn is_in_region(&self, c: usize) -> bool {
        let region = self.description().contacts[c].region;
        region.is_none_or(|place| self.dynamics.motion(place).value() > 0.0)
            || self.is_held_at(Guard::Region(c), 0.0)
    }

    /// Whether a guard's contact exists at part `s` of the step and just after it.
    pub(super) fn within_region(&self, guard: Guard, s: f64) -> bool {
        let Guard::Gap(c) = guard else {
            return true;
        };
        let edge = Guard::Region(c);
        let Some(curve) = self.locator.polynomials.of(edge) else {
            return true;
        };
        // What another contact holds at the edge, but for rounding, is in the region as what is there exactly is.
        let contacts = self.now.mode.contacts.iter().enumerate();
        let mut others = contacts.filter(|&(other, closed)| other != c && *closed);
        if self.is_held_at(edge, s) || others.next().is_some() && self.stays_at_edge(edge, curve) {
            return true;
        }
        // Just after the edge has been located, its first coefficient is zero.
        // Of an edge that is rounding over the whole step roots tell nothing.
        let is_in = |curve| self.readings(edge, curve, s).any(|value| value >= 0.0);
        !self.leaves(c, curve, s) && self.judged(edge, curve).is_none_or(is_in)
    }

    /// Whether the motion is at the edge of contact `c`, of this curve, and goes out.
    fn leaves(&self, c: usize, edge: &[f64], s: f64) -> bool {
        let guard = Guard::Region(c);
        self.falls_here(guard, edge, s) && self.distance(guard, edge, s) <= self.touching(c)
    }

    /// What a guard of this curve is at part `s` of the step, and where its root was found on the dense output.
    fn readings<'a>(
        &self,
        guard: Guard,
        curve: &'a [f64],
        s: f64,
    ) -> impl Iterator<Item = f64> + use<'a, T> {
        let places = [s, self.interpolated(guard, s)];
        places.into_iter().map(|s| value(curve, s))
    }

    /// How far a guard of this curve is from zero at part `s` of the step, by the reading that is nearer.
    pub(super) fn distance(&self, guard: Guard, curve: &[f64], s: f64) -> f64 {
        let readings = self.readings(guard, curve, s);
        readings.map(f64::abs).fold(f64::INFINITY, f64::min)
    }

    /// Whether a guard of this curve falls through zero at part `s` of the step, as steps are located.
    fn falls_here(&self, guard: Guard, curve: &[f64], s: f64) -> bool {
        let (distance, slope) = (self.distance(guard, curve, s), slope(curve, s));
        slope < 0.0 && distance <= self.blur(guard, curve, distance).max(-SOON * slope)
    }

    /// By so much a guard of this curve may be off that is `distance` from zero, as steps are located.
    fn blur(&self, guard: Guard, curve: &[f64], distance: f64) -> f64 {
        let size: f64 = curve.iter().map(|c| c.abs()).sum();
        let polynomials = &self.locator.polynomials;
        (LOCATED * size).max(polynomials.rounding(distance, guard, &self.dynamics))
    }

    /// Whether a guard is an edge that the motion is at over the whole step, as far as rounding tells: as what has come to rest there, or moves along it.
    pub(super) fn stays_at_edge(&self, guard: Guard, curve: &[f64]) -> bool {
        if !matches!(guard, Guard::Region(_)) {
            return false;
        }
        // Coefficients of an interpolation may be large and cancel.
        let mut sizes = (0..=PLACES).map(|k| value(curve, k as f64 / PLACES as f64).abs());
        let polynomials = &self.locator.polynomials;
        let resolved = rounding::<T>(OF_STEP) * self.stepper.step.extent();
        sizes.all(|size| {
            size <= polynomials
                .rounding(size, guard, &self.dynamics)
                .max(resolved)
        })
    }

    /// Where the motion enters the region of an open contact whose gap vanishes there: (part of the step, half width). It hits what is there already.
    pub(super) fn comes_onto(&self, edge: Guard, curve: &[f64]) -> Option<(f64, f64)> {
        let Guard::Region(c) = edge else {
            return None;
        };
        let surface = Guard::Gap(c);
        let gap = self.locator.polynomials.of(surface)?;
        let root = find_root(self.judged(edge, curve)?, Break)?;
        let enters = root.direction == Direction::Rising && !root.grazing;
        let (s, width) = self.place(edge, &root);
        let touches = self.distance(surface, gap, s) <= self.touching(c);
        (enters && touches && !self.is_held_at(edge, s)).then_some((s, width))
    }

    /// A gap of this size vanishes: the tolerance, but no less than rounding of what makes it.
    pub(super) fn touching(&self, c: usize) -> f64 {
        let rounding = rounding::<T>(ROUNDING) * self.locator.polynomials.extents[c];
        self.settings.tolerance.max(rounding)
    }

    /// Remembers which surfaces the motion is below at part `end` of the step.
    pub(super) fn remember_regions(&mut self, end: f64) {
        self.locator.passing.clear();
        let limited = |contact: &Contact| contact.region.is_some();
        if end == 0.0 || !self.description().contacts.iter().any(limited) {
            return;
        }
        let mut below = core::mem::take(&mut self.now.below);
        let mut passing = core::mem::take(&mut self.locator.passing);
        for (guard, curve) in self.locator.polynomials.of_mode() {
            let Guard::Gap(c) = guard else {
                continue;
            };
            if self.description().contacts[c].region.is_none()
                || self.locator.fallen.contains(&guard)
            {
                continue;
            }
            let gap = value(curve, end);
            // Within the region it can only be a root that rounding has put into the next step.
            let blur = self.blur(guard, curve, gap.abs());
            let passed = gap < -blur.max(self.touching(c)) || !self.within_region(guard, end);
            // What reaches the edge and the surface at once passes by it, unless it has been found to come onto it.
            let edge = self.locator.polynomials.of(Guard::Region(c));
            let passes = self.distance(guard, curve, end) <= self.touching(c)
                && self.falls_here(guard, curve, end)
                && !self.locator.fallen.contains(&Guard::Region(c))
                && !self.is_held_at(Guard::Region(c), end)
                && edge.is_some_and(|edge| self.leaves(c, edge, end));
            passing.extend(passes.then_some(c));
            below[c] = passes || gap < 0.0 && (below[c] || passed);
        }
        self.now.below = below;
        self.locator.passing = passing;
    }

    /// Ends the contacts whose regions the motion leaves at this instant: those at whose edge it is, unless an impact there has thrown it back or stopped it.
    pub(super) fn leave_regions(&mut self, hit: bool, facts: &mut SwitchFacts) {
        let fallen = core::mem::take(&mut self.locator.fallen);
        for guard in &fallen {
            if let Guard::Region(c) = *guard
                && self.now.mode.contacts[c]
                && (!hit || self.goes_out(c))
            {
                facts.touching[c] = false;
                // What goes out by its acceleration alone does not come back onto the surface where it is at the edge still.
                self.now.below[c] = true;
            }
        }
        self.locator.fallen = fallen;
    }

    /// Whether the present velocities lead out of the region of contact `c`, from its edge.
    fn goes_out(&mut self, c: usize) -> bool {
        let Some(place) = self.description().contacts[c].region else {
            return false;
        };
        let largest = |x: &[T]| x.iter().fold(0.0_f64, |size, x| size.max(x.value().abs()));
        let State { q, v, .. } = &self.now.state;
        let (extent, speed) = (1.0 + largest(q), largest(v).max(1.0));
        let soon = T::from_f64(SOON * extent / speed);
        let read = |run: &Self| run.dynamics.motion(place).value();
        let there = self.beside(None, soon, |_, v| soon * v, read);
        there - read(self) < -SOON * SOON * extent
    }

    /// One surface begins where another one ends, although their edges are located a little apart: rounding tells `x` from `x*(length - x)`.
    pub(super) fn meet_edges(&mut self, end: f64) {
        if !self.is_at_edge() {
            return;
        }
        let mut fallen = core::mem::take(&mut self.locator.fallen);
        let polynomials = &self.locator.polynomials;
        for (edge, curve) in polynomials.of_mode() {
            let Guard::Region(c) = edge else {
                continue;
            };
            let (distance, slope) = (self.distance(edge, curve, end), slope(curve, end));
            let surface = Guard::Gap(c);
            let crosses = match polynomials.of(surface) {
                _ if self.now.mode.contacts[c] => slope < 0.0,
                Some(gap) => slope > 0.0 && self.distance(surface, gap, end) <= self.touching(c),
                None => false,
            };
            // Polynomials are cut off where the tolerance allows it, and edges of surfaces that were entered are lowered by as much.
            let off = 2.0 * self.touching(c);
            if crosses
                && distance <= self.blur(edge, curve, distance).max(off)
                && !fallen.contains(&edge)
                && !self.is_held_at(edge, end)
                && !self.stays_at_edge(edge, curve)
            {
                fallen.push(edge);
            }
        }
        self.locator.fallen = fallen;
    }

    /// What is hit where a surface ends, to rounding, is hit there: the floor of a room ends at its walls.
    pub(super) fn hit_at_edge(&mut self, end: f64) {
        let closed = |guard: &Guard| {
            matches!(guard, Guard::Region(_)) && !is_edge_in_flight(*guard, &self.now.mode)
        };
        if !self.locator.fallen.iter().any(closed) {
            return;
        }
        let mut fallen = core::mem::take(&mut self.locator.fallen);
        let polynomials = &self.locator.polynomials;
        for (guard, curve) in polynomials.of_mode() {
            let gap = self.distance(guard, curve, end);
            let size: f64 = curve.iter().map(|c| c.abs()).sum();
            if matches!(guard, Guard::Gap(_))
                && !fallen.contains(&guard)
                && !self.is_below(guard)
                && slope(curve, end) < -HITS * size
                && gap <= polynomials.rounding(gap, guard, &self.dynamics)
                && self.within_region(guard, end)
            {
                fallen.push(guard);
            }
        }
        self.locator.fallen = fallen;
    }

    /// Whether the motion has come to the edge of a region.
    pub(super) fn is_at_edge(&self) -> bool {
        let mut fallen = self.locator.fallen.iter();
        fallen.any(|guard| matches!(guard, Guard::Region(_)))
    }

    /// At an edge the next surface may begin without a step: closes contacts whose gaps vanish where their regions begin. So they do where
    /// the motion has come onto the edge of a surface.
    pub(super) fn hand_over(&mut self) {
        self.locator.entered.clear();
        if !self.is_at_edge() {
            return;
        }
        let d = self.description();
        for (c, contact) in d.contacts.iter().enumerate() {
            let Some(region) = contact.region else {
                continue;
            };
            let was_closed = self.now.mode.contacts[c];
            if was_closed
                || self.locator.passing.contains(&c)
                || !self.dynamics.effects().includes(d, Item::Contact(c))
            {
                continue;
            }
            let number = |place: ValueRef| self.dynamics.motion(place).value();
            let gap = number(d.rows[contact.row].position.unwrap_or(ValueRef::Zero));
            let small = self.touching(c);
            let at_edge = self.locator.fallen.contains(&Guard::Region(c));
            if gap.abs() <= small && (at_edge || number(region) >= -small) {
                self.switcher.status.facts.touching[c] = true;
                self.switcher.status.facts.arriving[c] = true;
                self.locator.entered.push(c);
            }
        }
    }

    /// The edges of regions that have just been entered on the surface are where the motion is, to what projections move it.
    pub(super) fn let_enter(&mut self) {
        while let Some(c) = self.locator.entered.pop() {
            let small = self.touching(c);
            self.locator.polynomials.lower(Guard::Region(c), small);
        }
    }
}
