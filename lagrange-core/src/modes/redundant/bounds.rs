//! What bounds undetermined forces: contacts push, sticking frictions stay in their cones.

use super::RedundantForces;
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::mode::FrictionMode;
use crate::modes::guard::Guard;
use crate::system::{Normal, ValueRef};

/// A guard, or a side of a cone, that bounds undetermined forces: linear in them and relative to its size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub guard: Guard,
    pub along: [f64; 2],
    /// (index of an acting row, factor)
    pub terms: [(usize, f64); 3],
    pub size: f64,
    /// At the forces of least norm.
    pub value: f64,
}

/// A friction cone around undetermined forces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub friction: usize,
    /// Indices of acting rows.
    pub rows: [usize; 2],
    /// (index of an acting row, factor): what it can hold, beside `constant`.
    pub limit: (usize, f64),
    pub constant: f64,
    pub size: f64,
}

impl<T: Scalar> RedundantForces<T> {
    /// The bounds with a part that is open.
    pub(super) fn list_bounds(&mut self, dynamics: &Dynamics<T>) {
        let d = dynamics.description();
        let acting = dynamics.acting_rows();
        let index = |row: usize| acting.binary_search(&row).ok();
        let number = |place: ValueRef| dynamics.motion(place).value();
        let mode = dynamics.mode();
        for (c, contact) in d.contacts.iter().enumerate() {
            if let Some(i) = index(contact.row) {
                self.bound(Guard::Normal(c), [(i, 1.0), (i, 0.0)], 0.0, dynamics);
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
            let (limit, constant) = match friction.normal {
                Normal::Contact(c) => {
                    let factor = d.contacts[c].normal_factor.map_or(1.0, number);
                    let Some(row) = index(d.contacts[c].row) else {
                        continue;
                    };
                    ((row, coefficient * factor), 0.0)
                }
                Normal::Given(place) => ((i, 0.0), coefficient * number(place)),
                // |λ| is no linear bound.
                Normal::Constraint(_) => continue,
            };
            if friction.components == 1 {
                self.bound(Guard::StickUpper(f), [(i, -1.0), limit], constant, dynamics);
                self.bound(Guard::StickLower(f), [(i, 1.0), limit], constant, dynamics);
            } else if let Some(j) = index(friction.row + 1)
                && [limit.0, i, j]
                    .iter()
                    .any(|&i| !self.freedom.is_determined(i))
            {
                self.cones.push(Cone {
                    friction: f,
                    rows: [i, j],
                    limit,
                    constant,
                    size: self.sizes.of(Guard::StickCone(f), dynamics).sqrt(),
                });
            }
        }
    }

    /// Adds a bound, if it has a part that is open.
    fn bound(
        &mut self,
        guard: Guard,
        [first, second]: [(usize, f64); 2],
        constant: f64,
        dynamics: &Dynamics<T>,
    ) {
        let open = |j: usize| {
            let parts = [first, second].map(|(i, a)| a * self.freedom.row(i)[j]);
            (parts[0] + parts[1]).abs()
        };
        let most = (0..self.least.len()).map(open).fold(0.0, f64::max);
        if most > 1e-9 * first.1.abs().max(second.1.abs()) {
            let size = self.sizes.of(guard, dynamics);
            self.push(
                guard,
                [0.0; 2],
                [first, second, (first.0, 0.0)],
                constant,
                size,
            );
        }
    }

    /// Adds the side of a cone in direction `along`.
    pub(super) fn cut(&mut self, cone: usize, along: [f64; 2]) {
        let Cone {
            friction,
            rows,
            limit,
            constant,
            size,
        } = self.cones[cone];
        let terms = [(rows[0], -along[0]), (rows[1], -along[1]), limit];
        self.push(Guard::StickCone(friction), along, terms, constant, size);
    }

    fn push(
        &mut self,
        guard: Guard,
        along: [f64; 2],
        terms: [(usize, f64); 3],
        constant: f64,
        size: f64,
    ) {
        let size = size.max(f64::MIN_POSITIVE);
        let value: f64 = terms.iter().map(|&(i, a)| a * self.least[i].value()).sum();
        self.bounds.push(Bound {
            guard,
            along,
            terms,
            size,
            value: (value + constant) / size,
        });
    }
}
