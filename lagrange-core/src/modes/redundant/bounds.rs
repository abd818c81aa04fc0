//! What bounds undetermined forces: contacts push, sticking frictions stay in their cones.

use super::RedundantForces;
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::linear::{ForceBounds, Linear};
use crate::mode::FrictionMode;
use crate::modes::guard::{self, ConePlane, Guard};
use crate::system::{Normal, ValueRef};

/// A bound of undetermined forces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub guard: Guard,
    /// Sign of the constraint force that carries a friction.
    normal_sign: f64,
}

impl Bound {
    /// The plane that touches the cone in this direction.
    pub fn plane(&self, along: [f64; 2]) -> ConePlane {
        ConePlane {
            along,
            normal_sign: self.normal_sign,
        }
    }
}

/// The bounds with a part that is open.
#[derive(Clone, Debug, Default)]
pub(super) struct Bounds {
    pub list: Vec<Bound>,
    /// The same as cones over the forces.
    pub forces: ForceBounds,
}

impl Bounds {
    pub fn clear(&mut self) {
        self.list.clear();
        self.forces.clear();
    }
}

impl<T: Scalar> RedundantForces<T> {
    /// Lists the bounds with a part that is open.
    pub(super) fn list_bounds(&mut self, dynamics: &Dynamics<T>) {
        self.bounds.clear();
        let d = dynamics.description();
        let acting = dynamics.acting_rows();
        let index = |row: usize| acting.binary_search(&row).ok();
        let number = |place: ValueRef| dynamics.motion(place).value();
        let mode = dynamics.mode();
        for (c, contact) in d.contacts.iter().enumerate() {
            if let Some(i) = index(contact.row) {
                self.bound(Guard::Normal(c), 1.0, [(&[(i, 1.0)], 0.0)], dynamics);
            }
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            if mode.frictions[f] != FrictionMode::Stick {
                continue;
            }
            let Some(i) = index(friction.row) else {
                continue;
            };
            let coefficient = number(friction.static_coefficient);
            let mut normal_sign = 1.0;
            let mut limits = Vec::with_capacity(3);
            let constant = match friction.normal {
                Normal::Contact(c) => {
                    let factor = d.contacts[c].normal_factor.map_or(1.0, number);
                    let Some(row) = index(d.contacts[c].row) else {
                        continue;
                    };
                    limits.push((row, coefficient * factor));
                    0.0
                }
                Normal::Given(place) => coefficient * number(place),
                Normal::Constraint(on) => {
                    let Some(row) = index(d.constraints[on].row) else {
                        continue;
                    };
                    normal_sign = self.signs[on];
                    limits.push((row, coefficient * normal_sign));
                    0.0
                }
                // What the least forces press in their direction, others press at least.
                normal @ Normal::Resultant(_) => {
                    let rows = normal.rows(d).filter_map(index);
                    limits.extend(rows.map(|row| (row, self.least.forces[row].value())));
                    let size = limits.iter().map(|(_, force)| force * force).sum::<f64>();
                    let part = coefficient / size.sqrt().max(f64::MIN_POSITIVE);
                    limits.iter_mut().for_each(|(_, along)| *along *= part);
                    0.0
                }
            };
            if guard::stick_guards(f, friction).eq([Guard::StickCone(f)]) {
                let other = (friction.components > 1).then(|| index(friction.row + 1));
                let other = other.flatten().map(|j| (j, 1.0));
                let cone = [
                    (&limits[..], constant),
                    (&[(i, 1.0)], 0.0),
                    (other.as_slice(), 0.0),
                ];
                self.bound(Guard::StickCone(f), normal_sign, cone, dynamics);
            } else {
                let sides = [(Guard::StickUpper(f), -1.0), (Guard::StickLower(f), 1.0)];
                for (guard, sign) in sides {
                    let terms = [&[(i, sign)], &limits[..]].concat();
                    self.bound(guard, normal_sign, [(&terms, constant)], dynamics);
                }
            }
        }
        self.bounds.forces.complete();
    }

    /// Adds a bound, if it has a part that is open: s ≥ 0, or s₀ ≥ √(s₁² + s₂²).
    fn bound<const N: usize>(
        &mut self,
        guard: Guard,
        normal_sign: f64,
        rows: [Linear<'_>; N],
        dynamics: &Dynamics<T>,
    ) {
        let least = &self.least;
        let own = || {
            let own = self.sizes.of(guard, dynamics);
            if N == 1 { own } else { own.sqrt() }
        };
        let force = |i: usize| least.forces[i].value();
        let is_open = (self.bounds.forces).add(rows, force, &least.freedom, own);
        if is_open {
            self.bounds.list.push(Bound { guard, normal_sign });
        }
    }
}
