//! Loads that vanish together with the force that a friction holds: a body at rest in its guide under a force that keeps its direction inside the friction
//! cone and changes its sign, or only touches zero.
//!
//! What the friction could hold more, (μN)² − F², has a double zero there, and touches it from above. By the error of its polynomial it falls through zero as
//! far from there as the root of that. But forces are known to rounding: where load and force are nothing at the same instant, and the cone has room before
//! and behind it, nothing happens.

use super::Run;
use super::touching::UNITS_OF_TIME;
use crate::arithmetic::{Scalar, epsilon};
use crate::events::dip;
use crate::integrate::Integrator;
use crate::modes::guard::Guard;
use crate::system::Normal;

/// At these parts of the step before and behind the zero it is looked whether the cone has room, and where loads vanish.
const BESIDE: [f64; 4] = [1e-1, 1e-2, 1e-4, 1e-6];

/// A motion that hardly moves is known up to this part of a step at least.
const KNOWN: f64 = 1.25;

/// What is no larger than this beside the forces of the step is nothing.
const NOTHING: f64 = 1e-12;

/// What presses a friction, the force that it holds, and what it can hold, at an instant.
#[derive(Clone, Copy)]
struct Held {
    load: [f64; 3],
    force: [f64; 2],
    limit: f64,
}

impl Held {
    fn parts(&self) -> impl Iterator<Item = f64> {
        self.load.into_iter().chain(self.force)
    }

    fn size(&self) -> f64 {
        self.parts().fold(0.0, f64::hypot)
    }

    /// The forces along those of another instant.
    fn along(&self, other: &Self) -> f64 {
        let pairs = self.parts().zip(other.parts());
        pairs.map(|(x, y)| x * y).sum()
    }

    /// (μN)² − F²
    fn room(&self) -> f64 {
        self.limit * self.limit - self.force.iter().map(|force| force * force).sum::<f64>()
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

impl<T: Scalar> Run<T> {
    /// How far the polynomial of the cone of a friction falls below zero behind its root at part `end` of the step, if load and force vanish
    /// there. The motion is known up to part `known` of the step.
    pub(super) fn depth_where_load_vanishes(
        &mut self,
        friction: usize,
        end: f64,
        known: f64,
    ) -> Option<f64> {
        let guard = Guard::StickCone(friction);
        let normal = self.description().frictions[friction].normal;
        let curves = &self.locator.polynomials;
        if curves.is_lowered(guard) || matches!(normal, Normal::Contact(_)) {
            return None;
        }
        let (_, depth) = dip(curves.of(guard)?, end, f64::INFINITY)?;
        let mut zero = end;
        let mut largest = self.held_at(friction, 0.0)?.size();
        let mut rate = 0.0;
        let mut clear = false;
        let other = self.stepper.other.as_deref();
        let stiff = other.is_some_and(Integrator::is_stiff);
        for part in BESIDE {
            if zero - part < 0.0 || zero + part > known.max(KNOWN) {
                continue;
            }
            let around = [zero - part, zero, zero + part].map(|s| self.held_at(friction, s));
            let [before, middle, after] = around;
            let (before, middle, after) = (before?, middle?, after?);
            if !(before.room() > 0.0 && after.room() > 0.0) {
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
            clear |= before.room().min(after.room()) > 8.0 * depth;
            largest = largest.max(before.size()).max(after.size());
            let change = after.parts().zip(before.parts()).map(|(x, y)| x - y);
            rate = change.fold(0.0, f64::hypot) / (2.0 * part);
            zero += part * nearest_zero([before, middle, after].map(|held| held.along(&before)));
        }
        let step = &self.stepper.step;
        let (time, h) = (step.time(T::from_f64(zero)).value(), step.h.value());
        let known_to = UNITS_OF_TIME * epsilon::<T>() * time.abs() / h;
        let there = self.held_at(friction, zero)?;
        let vanishes = there.size() <= NOTHING * largest + rate * known_to;
        (clear && vanishes).then_some(depth)
    }

    /// The forces of a friction at part `s` of the step.
    fn held_at(&mut self, friction: usize, s: f64) -> Option<Held> {
        self.evaluate_end(s).ok()?;
        let d = self.description();
        let friction = &d.frictions[friction];
        let number = |place| self.dynamics.motion(place).value();
        let mut held = Held {
            load: [0.0; 3],
            force: [0.0; 2],
            limit: 0.0,
        };
        for (force, row) in held.force.iter_mut().zip(friction.rows()) {
            *force = self.dynamics.force(row).value();
        }
        let normal = match friction.normal {
            Normal::Given(place) => number(place),
            normal => {
                for (load, row) in held.load.iter_mut().zip(normal.rows(d)) {
                    *load = self.dynamics.force(row).value();
                }
                held.load.into_iter().fold(0.0, f64::hypot)
            }
        };
        held.limit = number(friction.static_coefficient) * normal;
        Some(held)
    }
}
