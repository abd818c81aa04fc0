//! Contacts limited to a region: `contact(table: y >= 0, where x <= length)`.
//!
//! Such a contact exists only where its region ≥ 0. A closed one whose region falls through zero opens, and its frictions end.
//! The surface has one side: a gap that closes within the region is an impact, one that closes outside it is not, and then the
//! motion is below the surface, until the gap has opened again, wherever that is. Below it may enter the region freely, and
//! come up through it. Where it enters the region on the surface, as a wheel that climbs a kerb, the contact closes.

use super::{Progress, Run};
use crate::arithmetic::{Scalar, rounding};
use crate::effects::Item;
use crate::events::{Direction, find_root};
use crate::integrate::{polynomial_derivative as slope, polynomial_value as value};
use crate::mode::Mode;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::Guard;
use crate::system::{Contact, ValueRef};
use crate::trajectory::State;
use core::ops::ControlFlow::{Break, Continue};

/// Gaps that other gaps hold at zero are off by no more than this, relative to what makes them.
const ROUNDING: f64 = 1e-12;

/// Whether a region and a gap change in proportion is seen in so many ways in which the state changes,
const WAYS: usize = 4;

/// to this share.
const ALIKE: f64 = 1e-3;

/// What closes by no more than this share of its terms over a step does not hit where a surface ends, but touches.
const HITS: f64 = 1e-6;

/// Roots are located to this share of what a guard changes by in a step.
const LOCATED: f64 = 1e-9;

/// Whether the motion goes out at an edge is seen over this share of its extent, and where it goes out by no more than this share of that again it does not.
const SOON: f64 = 1e-6;

/// What is within so many tolerances of an edge may be at it.
const NEARBY: f64 = 10.0;

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

    /// Whether a guard is the edge of a region beyond which another surface keeps the motion off this one, at part `s` of the step: it is in the region.
    pub(super) fn is_held_at(&self, guard: Guard, s: f64) -> bool {
        let Guard::Region(c) = guard else {
            return false;
        };
        let holder = self.locator.edges_held[c];
        holder.is_some_and(|by| s == 0.0 || self.is_near(by, s))
    }

    /// Notes at which edges other surfaces keep the motion at the present state: a floor that ends at a wall is there along that wall, however it leans or
    /// moves, and each side of a groove is there at its bottom.
    pub(super) fn note_edges_held(&mut self) {
        for c in 0..self.description().contacts.len() {
            self.locator.edges_held[c] = self.holder_of_edge(c, None);
        }
    }

    /// The same after part `end` of a step in which nothing happens.
    pub(super) fn note_edges_at(&mut self, end: f64) {
        for c in 0..self.description().contacts.len() {
            let edge = self.locator.polynomials.of(Guard::Region(c));
            let is_near = edge.is_some_and(|edge| value(edge, end).abs() <= 2.0 * self.nearby(c));
            self.locator.edges_held[c] = is_near.then(|| self.holder_of_edge(c, None)).flatten();
        }
    }

    /// Notes such edges to which the step at hand comes. Its series are made anew where that has taken their place.
    pub(super) fn note_edges_ahead(&mut self) {
        let before = self.now.series;
        for c in 0..self.description().contacts.len() {
            if self.locator.edges_held[c].is_none()
                && let Some(s) = self.comes_to_edge(c)
                && self.is_near_others(c, s)
            {
                self.locator.edges_held[c] = self.holder_of_edge(c, Some(s));
                self.now.series = Progress::None;
            }
        }
        if before != self.now.series {
            self.ask_for_guards();
            // What fails here fails again in the next try.
            _ = self.expand();
        }
    }

    /// The part of the step at hand at which the motion comes to the edge of contact `c`, or to its surface near the edge.
    fn comes_to_edge(&self, c: usize) -> Option<f64> {
        let curves = &self.locator.polynomials;
        let edge = curves.of(Guard::Region(c))?;
        let near = |s: f64| value(edge, s).abs() <= self.nearby(c);
        find_root(edge, |root| Break(root.s)).or_else(|| {
            find_root(curves.of(Guard::Gap(c))?, |root| match near(root.s) {
                true => Break(root.s),
                false => Continue(()),
            })
        })
    }

    /// Whether the motion is near the surface of another contact than `c` at a part of the step at hand.
    fn is_near_others(&self, c: usize, s: f64) -> bool {
        (0..self.description().contacts.len()).any(|by| by != c && self.is_near(by, s))
    }

    /// Whether the motion is near the surface of a contact at a part of the step at hand.
    fn is_near(&self, c: usize, s: f64) -> bool {
        let gap = self.locator.polynomials.of(Guard::Gap(c));
        self.now.mode.contacts[c] || gap.is_some_and(|gap| value(gap, s).abs() <= self.nearby(c))
    }

    /// The contact, if there is one, whose surface keeps the motion off that of contact `c` beyond the edge at which it is, at the present state or at a
    /// part of the step at hand.
    fn holder_of_edge(&mut self, c: usize, part: Option<f64>) -> Option<usize> {
        let d = self.description();
        let region = d.contacts[c].region?;
        let mut others = (0..d.contacts.len()).filter(|&by| by != c);
        others.find(|&by| self.holds_at_edge(by, c, region, part))
    }

    /// Whether contact `by` does so at this edge.
    fn holds_at_edge(&mut self, by: usize, c: usize, region: ValueRef, part: Option<f64>) -> bool {
        let d = self.description();
        let takes_part = self.dynamics.effects().includes(d, Item::Contact(by));
        if !takes_part || self.now.below[by] {
            return false;
        }
        let number = |place: ValueRef, run: &Self| run.dynamics.motion(place).value();
        let read = |run: &Self| {
            let others = d.contacts[by]
                .region
                .map_or(f64::INFINITY, |place| number(place, run));
            [number(region, run), run.gap(c), run.gap(by), others]
        };
        let here = self.beside(part, T::zero(), |_, _| T::zero(), read);
        let near = [self.nearby(c), self.nearby(by)];
        if here[0].abs() > near[0] || here[2].abs() > near[1] || here[3] < -near[1] {
            return false;
        }
        let changes: [[f64; 4]; WAYS] = core::array::from_fn(|way| {
            // Roots, of which no sum is a multiple of another: cosines of an even spacing have means that are.
            let phase = |j: usize| (1 + way) as f64 * (1.0 + j as f64).sqrt();
            let along = |j: usize| T::from_f64(SOON * phase(j).cos());
            let there = self.beside(part, along(0), |j, _| along(j + 1), read);
            core::array::from_fn(|k| there[k] - here[k])
        });
        // A surface that ends here as well is there beyond this edge.
        keeps_off(&changes) && (here[3] > near[1] || goes_on(&changes))
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
        if self.is_held_at(edge, s) {
            return true;
        }
        // Just after the edge has been located, its first coefficient is zero.
        let is_in = |curve| value(curve, s) >= 0.0;
        !self.leaves(c, curve, s) && self.judged(edge, curve).is_none_or(is_in)
    }

    /// Whether the motion is at the edge of contact `c`, of this curve, and goes out.
    fn leaves(&self, c: usize, edge: &[f64], s: f64) -> bool {
        self.falls_here(Guard::Region(c), edge, s) && value(edge, s).abs() <= self.touching(c)
    }

    /// Whether a guard of this curve falls through zero at part `s` of the step, as steps are located.
    fn falls_here(&self, guard: Guard, curve: &[f64], s: f64) -> bool {
        let (distance, slope) = (value(curve, s).abs(), slope(curve, s));
        slope < 0.0 && distance <= self.blur(guard, curve, distance).max(-SOON * slope)
    }

    /// By so much a guard of this curve may be off that is `distance` from zero, as steps are located.
    fn blur(&self, guard: Guard, curve: &[f64], distance: f64) -> f64 {
        let size: f64 = curve.iter().map(|c| c.abs()).sum();
        let polynomials = &self.locator.polynomials;
        (LOCATED * size).max(polynomials.rounding(distance, guard, &self.dynamics))
    }

    /// Whether a guard is an edge that the motion is at over the whole step, as far as rounding tells: as what has come to rest there.
    pub(super) fn stays_at_edge(&self, guard: Guard, curve: &[f64]) -> bool {
        // Coefficients of an interpolation may be large and cancel.
        let mut sizes = (0..=PLACES).map(|k| value(curve, k as f64 / PLACES as f64).abs());
        let polynomials = &self.locator.polynomials;
        let vanishes = |size| size <= polynomials.rounding(size, guard, &self.dynamics);
        matches!(guard, Guard::Region(_)) && sizes.all(vanishes)
    }

    /// Where the motion enters the region of an open contact whose gap vanishes there: (part of the step, half width). It hits what is there already.
    pub(super) fn comes_onto(&self, edge: Guard, curve: &[f64]) -> Option<(f64, f64)> {
        let Guard::Region(c) = edge else {
            return None;
        };
        let gap = self.locator.polynomials.of(Guard::Gap(c))?;
        let root = find_root(self.judged(edge, curve)?, Break)?;
        let enters = root.direction == Direction::Rising && !root.grazing;
        let (s, width) = self.place(edge, &root);
        let touches = value(gap, s).abs() <= self.touching(c);
        (enters && touches && !self.is_held_at(edge, s)).then_some((s, width))
    }

    /// What is no farther than this from the edge of contact `c`, or from its surface, is near.
    fn nearby(&self, c: usize) -> f64 {
        SOON.max(NEARBY * self.touching(c))
    }

    /// A gap of this size vanishes: the tolerance, but no less than rounding of what makes it.
    fn touching(&self, c: usize) -> f64 {
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
            let passes = gap.abs() <= self.touching(c)
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
            let gap = value(curve, end).abs();
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
            if gap.abs() <= small && number(region) >= -small {
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

/// Whether the first of these quantities that vanish, a region, keeps the second, a gap, above zero where it is negative itself and the third, the gap of
/// another contact, is not, as the ways in which they change tell: region = a·gap + b·other, to first order, with a ≤ 0 < b.
fn keeps_off(changes: &[[f64; 4]]) -> bool {
    shares(changes, 0, [1, 2]).is_some_and(|[a, b]| a <= 0.0 && b > 0.0)
}

/// Whether the last of these quantities, the region of the other contact, is positive where the first one is negative and the gap is not.
fn goes_on(changes: &[[f64; 4]]) -> bool {
    shares(changes, 3, [0, 1]).is_some_and(|[a, b]| a <= 0.0 && b >= 0.0)
}

/// In which shares one of these quantities changes with two others, if it does in the same shares, whichever way: with one of them alone if it does.
fn shares(changes: &[[f64; 4]], one: usize, [i, k]: [usize; 2]) -> Option<[f64; 2]> {
    let product = |i: usize, k: usize| changes.iter().map(|x| x[i] * x[k]).sum::<f64>();
    let free = product(i, i) * product(k, k) - product(i, k) * product(i, k);
    let both = [
        (product(one, i) * product(k, k) - product(one, k) * product(i, k)) / free,
        (product(one, k) * product(i, i) - product(one, i) * product(i, k)) / free,
    ];
    let alone = [i, k].map(|i| product(one, i) / product(i, i));
    let explain = |[a, b]: &[f64; 2]| {
        let mut rests = changes.iter().map(|x| x[one] - a * x[i] - b * x[k]);
        rests.all(|rest| rest.abs() <= ALIKE * product(one, one).sqrt())
    };
    [[0.0, alone[1]], [alone[0], 0.0], both]
        .into_iter()
        .find(explain)
}
