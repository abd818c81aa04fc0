//! Surfaces that end at one another: the sides of a groove at its bottom, a floor at the wall behind it.
//!
//! Where a region ends, rounding decides on which side the motion is. If another surface keeps the motion off beyond the edge, a contact is there as far as that
//! surface is near: to first order its region = a·gap + b·gap of the other contact with a ≤ 0 < b, so that what is outside is above it.

use super::{Progress, Run};
use crate::arithmetic::Scalar;
use crate::effects::Item;
use crate::events::find_root;
use crate::integrate::polynomial_value as value;
use crate::modes::guard::Guard;
use crate::system::{Description, ValueRef};
use core::ops::ControlFlow::{Break, Continue};

/// How quantities change together is seen in so many ways in which the state changes,
const WAYS: usize = 4;

/// by so much,
const BESIDE: f64 = 1e-6;

/// to this share.
const ALIKE: f64 = 1e-3;

/// What is no farther than this from an edge, or within so many tolerances, may be at it.
const NEAR: f64 = 1e-6;
const NEARBY: f64 = 10.0;

impl<T: Scalar> Run<T> {
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
        for c in limited(self.description()) {
            self.locator.edges_held[c] = self.holder_of_edge(c, None);
        }
    }

    /// The same after part `end` of a step in which nothing happens.
    pub(super) fn note_edges_at(&mut self, end: f64) {
        for c in limited(self.description()) {
            let edge = self.locator.polynomials.of(Guard::Region(c));
            let is_near = edge.is_some_and(|edge| value(edge, end).abs() <= 2.0 * self.nearby(c));
            self.locator.edges_held[c] = is_near.then(|| self.holder_of_edge(c, None)).flatten();
        }
    }

    /// Notes such edges to which the step at hand comes. Its series are made anew where that has taken their place.
    pub(super) fn note_edges_ahead(&mut self) {
        let before = self.now.series;
        for c in limited(self.description()) {
            if self.locator.edges_held[c].is_none()
                && let Some(s) = self.comes_to_edge(c)
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

    /// The part of the step at hand at which the motion comes to the edge of contact `c`, or to its surface near the edge, where another surface is near.
    fn comes_to_edge(&self, c: usize) -> Option<f64> {
        let curves = &self.locator.polynomials;
        let [region, surface] = [Guard::Region(c), Guard::Gap(c)];
        let edge = curves.of(region)?;
        let is_there =
            |s: f64| self.distance(region, edge, s) <= self.nearby(c) && self.is_near_others(c, s);
        let comes = |guard: Guard, curve: &[f64]| {
            find_root(curve, |root| {
                let (s, _) = self.place(guard, &root);
                match is_there(s) {
                    true => Break(s),
                    false => Continue(()),
                }
            })
        };
        comes(region, edge).or_else(|| comes(surface, curves.of(surface)?))
    }

    /// Whether the motion is near the surface of another contact than `c` at a part of the step at hand.
    fn is_near_others(&self, c: usize, s: f64) -> bool {
        (0..self.description().contacts.len()).any(|by| by != c && self.is_near(by, s))
    }

    /// Whether the motion is near the surface of a contact at a part of the step at hand.
    fn is_near(&self, c: usize, s: f64) -> bool {
        let surface = Guard::Gap(c);
        let is_near = |gap: &[f64]| self.distance(surface, gap, s) <= self.nearby(c);
        self.now.mode.contacts[c] || self.locator.polynomials.of(surface).is_some_and(is_near)
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
        // Within a step the curves are looked at, which may be known better than the motion.
        let is_near = match part {
            Some(s) => self.is_near(by, s),
            None => here[0].abs() <= near[0] && here[2].abs() <= near[1],
        };
        if !is_near || here[3] < -near[1] {
            return false;
        }
        let changes: [[f64; 4]; WAYS] = core::array::from_fn(|way| {
            // Roots, of which no sum is a multiple of another: cosines of an even spacing have means that are.
            let phase = |j: usize| (1 + way) as f64 * (1.0 + j as f64).sqrt();
            let along = |j: usize| T::from_f64(BESIDE * phase(j).cos());
            let there = self.beside(part, along(0), |j, _| along(j + 1), read);
            core::array::from_fn(|k| there[k] - here[k])
        });
        // A surface that ends here as well is there beyond this edge.
        keeps_off(&changes) && (here[3] > near[1] || goes_on(&changes))
    }

    /// What is no farther than this from the edge of contact `c`, or from its surface, is near.
    fn nearby(&self, c: usize) -> f64 {
        NEAR.max(NEARBY * self.touching(c))
    }
}

/// The contacts that are limited to a region.
fn limited(d: &Description) -> impl Iterator<Item = usize> {
    let contacts = d.contacts.iter().enumerate();
    contacts
        .filter(|(_, contact)| contact.region.is_some())
        .map(|(c, _)| c)
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
