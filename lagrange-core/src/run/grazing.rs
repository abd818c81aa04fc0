//! Gaps that a polynomial takes below zero and that are not: those of distances, which have no direction where they vanish, and of surfaces that
//! come to a body without speed. So are edges at which a brake brings a body to rest.

use super::Run;
use super::hit::Hit;
use super::touching::LEVER;
use crate::arithmetic::Scalar;
use crate::events::dip;
use crate::integrate::{horner, polynomial_derivative as slope};
use crate::modes::guard::Guard;
use crate::trajectory::State;

/// How far beyond a hit its gap is looked at, in units of the tolerance.
const BEYOND: f64 = 10.0;

impl<T: Scalar> Run<T> {
    /// Lets gaps and edges that the step at hand hits fall as far below zero as their polynomials do, where these turn before they have fallen by more than the
    /// tolerance, and these themselves vanish there at most, as far as rounding tells; whether there are such. The motion is known up to part
    /// `known` of the step. Cones of friction too, where [load and force vanish together](super::vanishing_loads).
    ///
    /// What rises to a body and comes to rest where it meets it would be hit a little before, by the root of the error of its series: at a speed that
    /// it does not have, while it brakes harder than what lies on it can be braked with.
    pub(super) fn passes_over_touches(&mut self, hit: &Hit, known: f64) -> bool {
        let Hit::Guards(end) = *hit else {
            return false;
        };
        let mut passes = false;
        for k in 0..self.locator.fallen.len() {
            let guard = self.locator.fallen[k];
            let margin = match guard {
                Guard::Gap(contact) => {
                    let extent = self.locator.polynomials.extents[contact];
                    let depth = self.depth_of_touch(guard, extent, end, known);
                    depth.map(|depth| 2.0 * depth / extent)
                }
                Guard::Region(contact) if self.now.mode.contacts[contact] => {
                    let depth = self.depth_of_touch(guard, 1.0, end, known);
                    depth.map(|depth| 2.0 * depth)
                }
                Guard::StickCone(_) | Guard::Composite(_) => {
                    let depth = self.depth_where_loads_vanish(guard, end, known);
                    depth.map(|depth| 2.0 * depth)
                }
                _ => None,
            };
            if let Some(margin) = margin {
                self.locator.polynomials.lower(guard, margin);
                passes = true;
            }
        }
        passes
    }

    /// How far the polynomial of a gap or an edge, of this extent, falls below zero behind its root at part `end` of the step, if that only touches zero.
    fn depth_of_touch(&mut self, guard: Guard, extent: f64, end: f64, known: f64) -> Option<f64> {
        let curves = &self.locator.polynomials;
        let index = curves.index_of(guard)?;
        let (_, curve) = curves.get(index)?;
        let least = self.settings.tolerance.max(1e-13) * extent;
        let (turn, depth) = dip(curve, end, BEYOND * least)?;
        if turn > known || curves.is_lowered(guard) {
            return None;
        }
        let (value, rounding) = match guard {
            Guard::Gap(contact) => {
                let value = self.value_at(index, turn);
                let off = self.largest_gap(|c| self.now.mode.contacts[c]);
                (value, self.rounding_of_gap(contact).max(LEVER * off))
            }
            _ => {
                // A track that only reaches to its edge is left there by as much as the motion is off it.
                self.evaluate_onto_constraints(turn).ok()?;
                let curves = &self.locator.polynomials;
                let value = curves.value(index, &self.now.mode, &self.dynamics);
                (value, curves.rounding(value.abs(), guard, &self.dynamics))
            }
        };
        (-value <= rounding).then_some(depth)
    }

    /// The contact that is hit by its polynomial but whose gap rises beyond, as far as the motion is known there, up to part `known` of the
    /// step: a distance √(x² + y²), which has no direction where it vanishes.
    ///
    /// Positions are known to the tolerance, so that is what is looked at beyond the hit; gaps in another unit, to what is left of them there.
    pub(super) fn gap_that_turns(&mut self, hit: &Hit, known: f64) -> Option<&'static str> {
        let Hit::Guards(end) = *hit else {
            return None;
        };
        for k in 0..self.locator.fallen.len() {
            let guard = self.locator.fallen[k];
            let Guard::Gap(contact) = guard else {
                continue;
            };
            let index = self.locator.polynomials.index_of(guard)?;
            self.state_at_end(end);
            let q = self.stepper.scratch.q.iter();
            let extent = self.locator.polynomials.extents[contact];
            let size = q.fold(extent, |size, q| size.max(q.value().abs()));
            let depth = BEYOND * self.settings.tolerance.max(1e-13) * size;
            let turns = self.turns_beyond(index, end, depth, known) && {
                let deeper = BEYOND * self.value_at(index, end).abs();
                deeper <= depth || self.turns_beyond(index, end, deeper, known)
            };
            if turns {
                return Some(self.description().contacts[contact].name);
            }
        }
        None
    }

    /// Whether the gap that guard number `index` watches is above zero where its curve is as far below as `depth`, behind its root at part `end` of
    /// the step.
    fn turns_beyond(&mut self, index: usize, end: f64, depth: f64, known: f64) -> bool {
        let Some((_, curve)) = self.locator.polynomials.get(index) else {
            return false;
        };
        let beyond = end + depth / slope(curve, end).abs();
        let fallen = horner(curve, beyond);
        if beyond > known || fallen > -0.5 * depth {
            return false;
        }
        let gap = self.value_at(index, beyond);
        // A distance is then what its polynomial is, of the other sign; where the series of a gap has stopped converging it is something else.
        gap > 0.5 * depth && (gap + fallen).abs() < 0.5 * depth
    }

    /// Guard number `index`, as declared, at part `s` of the step.
    fn value_at(&mut self, index: usize, s: f64) -> f64 {
        self.state_at_end(s);
        let State { q, v, .. } = &self.stepper.scratch;
        self.dynamics
            .tape(self.stepper.step.time(T::from_f64(s)), q, v);
        let curves = &self.locator.polynomials;
        curves.value(index, &self.now.mode, &self.dynamics)
    }
}
