//! Loads that vanish together with the force that a friction holds: a body at rest in its guide under a force that keeps its direction inside the friction
//! cone and changes its sign, or only touches zero.
//!
//! What the friction could hold more, (μN)² − F², has a double zero there, and touches it from above. By the error of its polynomial it falls through zero as
//! far from there as the root of that. But forces are known to rounding: where load and force are nothing at the same instant, and the cone has room before
//! and behind it, nothing happens.

use super::Run;
use super::guard_polynomials::GuardPolynomials;
use super::touching::UNITS_OF_TIME;
use crate::arithmetic::{Scalar, epsilon};
use crate::events::{RootList, dip, turns};
use crate::integrate::{Integrator, horner};
use crate::modes::guard::Guard;
use crate::system::Normal;

/// At these parts of the step before and behind the zero it is looked whether the cone has room, and where loads vanish.
const BESIDE: [f64; 4] = [1e-1, 1e-2, 1e-4, 1e-6];

/// A motion that hardly moves is known up to this part of a step at least.
const KNOWN: f64 = 1.25;

/// What is no larger than this beside the forces of the step is nothing.
const NOTHING: f64 = 1e-12;

/// Forces of more frictions than these are not looked at.
const MOST: usize = 8;

/// What presses frictions and the forces that they hold, at an instant, and the guard that tells whether they can.
#[derive(Clone, Copy)]
struct Held {
    forces: [f64; 5 * MOST],
    room: f64,
}

impl Held {
    fn size(&self) -> f64 {
        self.forces.into_iter().fold(0.0, f64::hypot)
    }

    /// The forces along those of another instant.
    fn along(&self, other: &Self) -> f64 {
        let pairs = self.forces.into_iter().zip(other.forces);
        pairs.map(|(x, y)| x * y).sum()
    }
}

/// Where what has these values at −1, 0 and 1, the first of them positive, is zero, or nearest to it: on a line where it changes its sign, and on a parabola
/// where it only touches zero.
fn nearest_zero([before, middle, after]: [f64; 3]) -> f64 {
    let zero = match after < 0.0 {
        true => 2.0 * before / (before - after) - 1.0,
        false => 0.5 * (before - after) / (before - 2.0 * middle + after),
    };
    match zero.abs() <= 1.0 {
        true => zero,
        false => 0.0,
    }
}

/// The frictions of which a guard tells whether they hold.
fn frictions_of(guard: Guard, curves: &GuardPolynomials) -> impl Iterator<Item = usize> {
    let composite = match guard {
        Guard::Composite(k) => &curves.composites[k].parts[..],
        _ => &[],
    };
    let of_parts = composite.iter().filter_map(|part| part.guard.holding());
    guard.holding().into_iter().chain(of_parts)
}

/// How far Σ cₖ sᵏ falls, but for rounding, below zero behind its root at `root`, where it turns up to `to` or next to the root; nothing if it does not turn.
fn depth_beyond<T: Scalar>(c: &[f64], root: f64, to: f64) -> Option<f64> {
    let mut all = RootList::new();
    turns(c, &mut all);
    let there = all.iter().filter(|turn| turn.s > root && turn.s <= to);
    let depths = there.map(|turn| -horner(c, turn.s));
    let beside = dip(c, root, f64::INFINITY).map(|(_, depth)| depth);
    let deepest = depths.chain(beside).reduce(f64::max)?;
    let sizes = c.iter().map(|c| c.abs());
    Some(deepest.max(epsilon::<T>() * sizes.sum::<f64>()))
}

impl<T: Scalar> Run<T> {
    /// How far the polynomial of the cone of a friction, or of what several can hold together, falls below zero behind its root at part `end` of the step,
    /// if load and force vanish there. The motion is known up to part `known` of the step.
    pub(super) fn depth_where_loads_vanish(
        &mut self,
        guard: Guard,
        end: f64,
        known: f64,
    ) -> Option<f64> {
        let curves = &self.locator.polynomials;
        let on_contact = |f: usize| {
            let normal = self.description().frictions[f].normal;
            matches!(normal, Normal::Contact(_))
        };
        let other_parts = match guard {
            Guard::Composite(k) => {
                (curves.composites[k].parts.iter()).any(|part| part.guard.holding().is_none())
            }
            _ => false,
        };
        if curves.is_lowered(guard) || other_parts || frictions_of(guard, curves).any(on_contact) {
            return None;
        }
        let depth = depth_beyond::<T>(curves.of(guard)?, end, end + BESIDE[0])?;
        let mut zero = end;
        let mut largest = self.held_at(guard, 0.0)?.size();
        let mut rate = 0.0;
        let mut clear = false;
        let other = self.stepper.other.as_deref();
        let stiff = other.is_some_and(Integrator::is_stiff);
        for part in BESIDE {
            if zero - part < 0.0 || zero + part > known.max(KNOWN) {
                continue;
            }
            let around = [zero - part, zero, zero + part].map(|s| self.held_at(guard, s));
            let [before, middle, after] = around;
            let (before, middle, after) = (before?, middle?, after?);
            if !(before.room > 0.0 && after.room > 0.0) {
                // Farther away something else may happen.
                if part == BESIDE[0] {
                    continue;
                }
                return None;
            }
            // Steps of a stiff method are made again, and shorter, where an interpolation dips.
            if stiff && after.along(&before) > 0.0 {
                return None;
            }
            // A margin that hides nothing but what is nearer.
            clear |= before.room.min(after.room) > 8.0 * depth;
            largest = largest.max(before.size()).max(after.size());
            let change = after
                .forces
                .into_iter()
                .zip(before.forces)
                .map(|(x, y)| x - y);
            rate = change.fold(0.0, f64::hypot) / (2.0 * part);
            zero += part * nearest_zero([before, middle, after].map(|held| held.along(&before)));
        }
        let step = &self.stepper.step;
        let (time, h) = (step.time(T::from_f64(zero)).value(), step.h.value());
        let known_to = UNITS_OF_TIME * epsilon::<T>() * time.abs() / h;
        let there = self.held_at(guard, zero)?;
        let vanishes = there.size() <= NOTHING * largest + rate * known_to;
        (clear && vanishes).then_some(depth)
    }

    /// The forces of the frictions of a guard at part `s` of the step.
    fn held_at(&mut self, guard: Guard, s: f64) -> Option<Held> {
        self.evaluate_end(s).ok()?;
        let d = self.description();
        let curves = &self.locator.polynomials;
        let mut held = Held {
            forces: [0.0; 5 * MOST],
            room: curves.value(curves.index_of(guard)?, &self.now.mode, &self.dynamics),
        };
        let mut slots = held.forces.iter_mut();
        for f in frictions_of(guard, curves) {
            let friction = &d.frictions[f];
            let given = match friction.normal {
                Normal::Given(place) => Some(self.dynamics.motion(place)),
                _ => None,
            };
            let rows = friction.rows().chain(friction.normal.rows(d));
            for force in rows.map(|row| self.dynamics.force(row)).chain(given) {
                *slots.next()? = force.value();
            }
        }
        Some(held)
    }
}
