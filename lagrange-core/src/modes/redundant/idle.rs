//! Frictions that can hold nothing, as on ice, beside others that hold the same slip: their forces are nothing, and are left out of the choice. Their bounds
//! leave no margin, and would hide what comes near to its own.

use super::RedundantForces;
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::mode::FrictionMode;
use crate::modes::composite::Part;
use crate::modes::guard::{self, ConePlane, Guard};
use crate::system::{Friction, Normal, ValueRef};

/// A force that is not determined, and has been chosen to be nothing.
#[derive(Clone, Debug)]
pub(super) struct Idle {
    friction: usize,
    /// Whether its bound is a cone.
    is_cone: bool,
    /// Along the first or second of its components.
    component: usize,
    /// Index of the force.
    force: usize,
    /// How the other forces follow from it, per force.
    along: Vec<f64>,
}

impl Idle {
    /// Whether a guard says how much this friction holds.
    pub fn has(&self, guard: Guard) -> bool {
        guard.holding() == Some(self.friction)
    }

    /// The guards of this friction whose sum is these forces of it, but for what it can hold.
    fn part(&self, forces: [f64; 2]) -> Part {
        let weight = forces[0].hypot(forces[1]);
        let (guard, plane) = match (self.is_cone, forces[0] > 0.0) {
            (true, _) => {
                let plane = ConePlane {
                    along: forces.map(|force| -force / weight),
                    pressing: [1.0, 0.0, 0.0],
                };
                (Guard::StickCone(self.friction), Some(plane))
            }
            (false, true) => (Guard::StickLower(self.friction), None),
            (false, false) => (Guard::StickUpper(self.friction), None),
        };
        Part {
            guard,
            plane,
            weight,
        }
    }
}

impl<T: Scalar> RedundantForces<T> {
    /// Chooses the forces of frictions that can hold nothing, where others can do without them.
    pub(super) fn choose_idle(&mut self, dynamics: &Dynamics<T>) {
        self.idle.clear();
        let d = dynamics.description();
        let acting = dynamics.acting_rows();
        let is_zero = |place: ValueRef| dynamics.motion(place).value() == 0.0;
        for (f, friction) in d.frictions.iter().enumerate() {
            let unpressed = matches!(friction.normal, Normal::Given(place) if is_zero(place));
            let sticks = dynamics.mode().frictions[f] == FrictionMode::Stick;
            if !sticks || !unpressed && !is_zero(friction.static_coefficient) {
                continue;
            }
            for (component, row) in friction.rows().enumerate() {
                let Ok(force) = acting.binary_search(&row) else {
                    continue;
                };
                if let Some(along) = self.least.choose_zero(force) {
                    self.idle.push(Idle {
                        friction: f,
                        is_cone: guard::stick_guards(f, friction).eq([Guard::StickCone(f)]),
                        component,
                        force,
                        along: along.into_iter().map(T::value).collect(),
                    });
                }
            }
        }
    }

    /// Whether all that a friction could hold with has been chosen to be nothing: it keeps its bounds, by no margin.
    pub(super) fn is_idle(&self, f: usize, friction: &Friction) -> bool {
        let chosen = self.idle.iter().filter(|idle| idle.friction == f);
        chosen.count() == friction.components
    }

    /// What idle forces add to a sum of forces with these factors, so that it is determined whatever they are: guards of theirs.
    pub(super) fn parts_of_idle(&self, mut factors: Vec<f64>) -> Vec<Part> {
        let mut needed: Vec<(&Idle, [f64; 2])> = Vec::new();
        for idle in self.idle.iter().rev() {
            let along = idle.along.iter().zip(&factors);
            let missing = -along.map(|(x, y)| x * y).sum::<f64>();
            factors[idle.force] += missing;
            let mut known = needed.iter_mut();
            match known.find(|(other, _)| other.friction == idle.friction) {
                Some((_, forces)) => forces[idle.component] = missing,
                None => {
                    let mut forces = [0.0; 2];
                    forces[idle.component] = missing;
                    needed.push((idle, forces));
                }
            }
        }
        let needed = needed.into_iter().filter(|(_, forces)| *forces != [0.0; 2]);
        needed.map(|(idle, forces)| idle.part(forces)).collect()
    }

    /// How forces change where those that idle frictions have by `value`, a function of their guards, are taken from them, per force.
    pub(super) fn without_idle(
        &self,
        mut value: impl FnMut(Guard, Option<ConePlane>) -> f64,
    ) -> Vec<f64> {
        let mut changes = vec![0.0; self.least.forces.len()];
        for idle in &self.idle {
            let mut side = |sign: f64| {
                let mut forces = [0.0; 2];
                forces[idle.component] = sign;
                let part = idle.part(forces);
                value(part.guard, part.plane)
            };
            let force = 0.5 * (side(1.0) - side(-1.0)) + changes[idle.force];
            for (change, part) in changes.iter_mut().zip(&idle.along) {
                *change -= force * part;
            }
        }
        changes
    }
}
