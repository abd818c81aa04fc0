//! What bounds undetermined forces: contacts push, sticking frictions stay in their cones.

use super::RedundantForces;
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::linear::{Cone, ConicPoint, ConicProgram};
use crate::mode::FrictionMode;
use crate::modes::guard::{self, ConePlane, Guard};
use crate::system::{Normal, ValueRef};
use nalgebra::{DMatrix, DVector};

/// A guard bounds forces that are open if one of them changes it by more than this, relative.
const OPEN: f64 = 1e-9;

/// Bounds are compared with this share of the largest at least: the size of one may be that of a coordinate that hardly has any inertia.
const SMALLEST: f64 = 1e-12;

/// What is left of an open part that cancels, relative.
const CANCELLED: f64 = 1e-12;

/// A bound of undetermined forces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub guard: Guard,
    /// Its rows in the lists of all.
    pub cone: Cone,
    /// Of the terms that make it.
    pub size: f64,
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

/// The bounds with a part that is open, each linear in the forces and relative to its size.
#[derive(Clone, Debug, Default)]
pub(super) struct Bounds {
    pub list: Vec<Bound>,
    /// At the forces of least norm.
    pub values: Vec<f64>,
    /// How each row depends on the forces that act, without what has an effect.
    changes: Vec<DVector<f64>>,
    /// B, an orthogonal basis of these, of vectors that are equally long,
    pub basis: DMatrix<f64>,
    /// and how each row depends on it.
    open: DMatrix<f64>,
}

impl Bounds {
    pub fn clear(&mut self) {
        self.list.clear();
        self.values.clear();
        self.changes.clear();
    }

    /// The least of bounds with these `values` as they are.
    pub fn least(&self, values: &[f64]) -> f64 {
        let of = |bound: &Bound| match bound.cone {
            Cone::Ray(i) => values[i],
            Cone::SecondOrder(i) => values[i] - values[i + 1].hypot(values[i + 2]),
        };
        self.list.iter().map(of).fold(f64::INFINITY, f64::min)
    }

    /// The forces (y, margin) that keep bounds with these `values` by the largest margin up to `most`.
    pub fn widest(&self, values: &[f64], most: f64) -> ConicPoint {
        let (rows, columns) = self.open.shape();
        let mut a = self.open.clone().resize(rows + 1, columns + 1, 0.0);
        let mut cones = self.cones();
        cones.push(Cone::Ray(rows));
        for cone in &cones {
            a[(cone.first(), columns)] = -1.0;
        }
        let mut start = DVector::zeros(columns + 1);
        start[columns] = self.least(values).min(most) - 1.0;
        let mut c = DVector::zeros(columns + 1);
        c[columns] = -1.0;
        let program = ConicProgram {
            squares: DVector::zeros(columns + 1),
            c,
            a,
            b: DVector::from_iterator(rows + 1, values.iter().copied().chain([most])),
            cones,
        };
        program.solve(start)
    }

    /// By how much forces can keep all bounds, at most 1, or must break one.
    pub fn widest_margin(&self) -> f64 {
        self.widest(&self.values, 1.0).x[self.basis.ncols()]
    }

    /// What is to be solved for the forces of least norm that keep all bounds by `margin`.
    pub fn nearest(&self, margin: f64) -> ConicProgram {
        let columns = self.open.ncols();
        let mut b = DVector::from_column_slice(&self.values);
        for bound in &self.list {
            b[bound.cone.first()] -= margin;
        }
        ConicProgram {
            squares: DVector::repeat(columns, 1.0),
            c: DVector::zeros(columns),
            a: self.open.clone(),
            b,
            cones: self.cones(),
        }
    }

    fn cones(&self) -> Vec<Cone> {
        self.list.iter().map(|bound| bound.cone).collect()
    }

    /// Makes all bounds relative to their sizes, and finds a basis of what they depend on.
    fn complete(&mut self, forces: usize) {
        let sizes = self.list.iter().map(|bound| bound.size);
        let least = (SMALLEST * sizes.fold(0.0, f64::max)).max(f64::MIN_POSITIVE);
        let basis = basis(&self.changes, forces);
        self.open = DMatrix::from_fn(self.changes.len(), basis.ncols(), |i, j| {
            self.changes[i].dot(&basis.column(j))
        });
        for bound in &mut self.list {
            bound.size = bound.size.max(least);
            for row in bound.cone.rows() {
                self.values[row] /= bound.size;
                self.open.row_mut(row).unscale_mut(bound.size);
            }
        }
        // Numbers about 1.
        let scale = self
            .open
            .iter()
            .fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
        self.open /= scale;
        self.basis = basis / scale;
    }
}

/// An orthonormal basis of the space that these rows span (Gram & Schmidt, the largest remainder first).
fn basis(rows: &[DVector<f64>], width: usize) -> DMatrix<f64> {
    let units = rows.iter().filter_map(|row| row.try_normalize(0.0));
    let mut left: Vec<DVector<f64>> = units.collect();
    let mut basis: Vec<DVector<f64>> = Vec::new();
    while let Some(largest) = (left.iter()).max_by(|x, y| x.norm().total_cmp(&y.norm()))
        && largest.norm() > OPEN
        && basis.len() < width
    {
        let mut next = largest.normalize();
        for known in &basis {
            next -= known * known.dot(&next);
        }
        next.normalize_mut();
        for row in &mut left {
            *row -= &next * next.dot(row);
        }
        basis.push(next);
    }
    DMatrix::from_iterator(width, basis.len(), basis.iter().flatten().copied())
}

/// A linear function of the forces: (index of an acting row, factor) of what it is the sum of, and a constant.
type Linear<'a> = (&'a [(usize, f64)], f64);

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
            let (limit, constant) = match friction.normal {
                Normal::Contact(c) => {
                    let factor = d.contacts[c].normal_factor.map_or(1.0, number);
                    let Some(row) = index(d.contacts[c].row) else {
                        continue;
                    };
                    ((row, coefficient * factor), 0.0)
                }
                Normal::Given(place) => ((i, 0.0), coefficient * number(place)),
                Normal::Constraint(on) => {
                    let Some(row) = index(d.constraints[on].row) else {
                        continue;
                    };
                    normal_sign = self.signs[on];
                    ((row, coefficient * normal_sign), 0.0)
                }
            };
            if guard::stick_guards(f, friction).eq([Guard::StickCone(f)]) {
                let other = (friction.components > 1).then(|| index(friction.row + 1));
                let other = other.flatten().map(|j| (j, 1.0));
                let cone = [
                    (&[limit][..], constant),
                    (&[(i, 1.0)], 0.0),
                    (other.as_slice(), 0.0),
                ];
                self.bound(Guard::StickCone(f), normal_sign, cone, dynamics);
            } else {
                let sides = [(Guard::StickUpper(f), -1.0), (Guard::StickLower(f), 1.0)];
                for (guard, sign) in sides {
                    self.bound(
                        guard,
                        normal_sign,
                        [(&[(i, sign), limit], constant)],
                        dynamics,
                    );
                }
            }
        }
        if !self.bounds.list.is_empty() {
            self.bounds.complete(self.least.forces.len());
        }
    }

    /// Adds a bound, if it has a part that is open: s ≥ 0, or s₀ ≥ √(s₁² + s₂²).
    fn bound<const N: usize>(
        &mut self,
        guard: Guard,
        normal_sign: f64,
        rows: [Linear<'_>; N],
        dynamics: &Dynamics<T>,
    ) {
        let changes = rows.map(|(terms, _)| {
            let largest = terms.iter().fold(0.0_f64, |m, (_, a)| m.max(a.abs()));
            let change = DVector::from_fn(self.least.forces.len(), |j, _| {
                terms
                    .iter()
                    .map(|&(i, a)| a * self.least.freedom.row(i)[j])
                    .sum()
            });
            let share = if largest > 0.0 {
                change.amax() / largest
            } else {
                0.0
            };
            (change, share)
        });
        if changes.iter().all(|&(_, share)| share <= OPEN) {
            return;
        }
        let made_of = rows.iter().map(|(terms, constant)| {
            let parts = terms
                .iter()
                .map(|&(i, a)| (a * self.least.forces[i].value()).abs());
            parts.sum::<f64>() + constant.abs()
        });
        let own = self.sizes.of(guard, dynamics);
        let size = made_of.fold(if N == 1 { own } else { own.sqrt() }, f64::max);
        let first = self.bounds.values.len();
        let cone = if N == 1 {
            Cone::Ray(first)
        } else {
            Cone::SecondOrder(first)
        };
        self.bounds.list.push(Bound {
            guard,
            cone,
            size,
            normal_sign,
        });
        for ((terms, constant), (mut change, share)) in rows.into_iter().zip(changes) {
            let value: f64 = terms
                .iter()
                .map(|&(i, a)| a * self.least.forces[i].value())
                .sum();
            self.bounds.values.push(value + constant);
            if share <= CANCELLED {
                change.fill(0.0);
            }
            self.bounds.changes.push(change);
        }
    }
}
