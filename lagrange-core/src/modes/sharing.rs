//! Forces that the motion does not determine: a table on four legs, a rod that sticks to two supports.
//!
//! With λ₀ of least norm and the projector P onto forces without effect, all λ₀ + P y move the system in the same way.
//! Contacts and sticking frictions bound them, G λ + c ≥ 0. The shares of least norm within these bounds are
//!
//! ```text
//! λ = λ₀ + P Gᵀ w        0 ≤ w ⟂ (G P Gᵀ) w + G λ₀ + c ≥ 0
//! ```
//!
//! Where this has no solution there are weights w ≥ 0 with P Gᵀ w = 0 and wᵀ (G λ + c) < 0 (Farkas): a sum of guards in
//! which everything open cancels, and which is negative. Such a sum is a [`Joint`] guard. It ends a mode where the guards
//! of single forces cannot: both frictions under a rod slip together, where μs (N₁ + N₂) − (F₁ + F₂) falls through zero.

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::linear::{Freedom, Lemke, LemkeOutcome};
use crate::mode::{FrictionMode, Mode};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::modes::scale::Sizes;
use crate::system::{Normal, Place, System};

/// Weighted guards whose sum is determined where they are not. The sum is relative to the terms that make it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Joint {
    /// The guards and their weights, all positive.
    pub parts: Vec<(Guard, f64)>,
}

/// [`guard::series`], also of joint guards.
pub fn series<S: System>(
    guard: Guard,
    joints: &[Joint],
    mode: &Mode,
    reading: &Reading<'_, S>,
    out: &mut [f64],
) {
    let Guard::Joint(index) = guard else {
        return guard::series(guard, mode, reading, out);
    };
    let mut part = [0.0; guard::LENGTH];
    let part = &mut part[..out.len()];
    out.fill(0.0);
    for &(guard, weight) in &joints[index].parts {
        guard::series(guard, mode, reading, part);
        for (sum, x) in out.iter_mut().zip(&*part) {
            *sum += weight * x;
        }
    }
}

/// [`guard::value`], also of joint guards.
pub fn value<S: System>(
    guard: Guard,
    joints: &[Joint],
    mode: &Mode,
    reading: &Reading<'_, S>,
) -> f64 {
    let mut value = [0.0];
    series(guard, joints, mode, reading, &mut value);
    value[0]
}

/// A guard that bounds undetermined forces, linear in them and relative to its size.
#[derive(Clone, Copy, Debug)]
struct Bound {
    guard: Guard,
    /// (index of an acting row, factor)
    terms: [(usize, f64); 2],
    size: f64,
    /// At the forces of least norm.
    value: f64,
}

/// Undetermined forces at one state; the memory is reused.
#[derive(Clone, Debug, Default)]
pub struct Sharing<T> {
    least: Vec<T>,
    freedom: Freedom,
    bounds: Vec<Bound>,
    /// G P Gᵀ
    matrix: Vec<f64>,
    q: Vec<f64>,
    sizes: Sizes,
    lemke: Lemke,
}

/// What rounding leaves of a bound, relative to its size.
const ROUNDING: f64 = 1e-10;

impl<T: Scalar> Sharing<T> {
    /// Forgets everything: all forces are determined.
    pub fn clear(&mut self) {
        self.bounds.clear();
        self.least.clear();
    }

    /// Looks at the last value of `dynamics`.
    pub fn look<S: System<Scalar = T>>(&mut self, dynamics: &Dynamics<S>) {
        self.clear();
        if !dynamics.has_dependent_rows() {
            return;
        }
        (self.least, self.freedom) = dynamics.least_norm_of_acting();
        self.sizes.take(dynamics);
        self.list_bounds(dynamics);
        let count = self.bounds.len();
        self.matrix.clear();
        for x in &self.bounds {
            for y in &self.bounds {
                let products = x.terms.iter().map(|&(i, a)| {
                    let row = self.freedom.row(i);
                    let sum: f64 = y.terms.iter().map(|&(j, b)| row[j] * b).sum();
                    a * sum
                });
                let product: f64 = products.sum();
                self.matrix.push(product / (x.size * y.size));
            }
        }
        debug_assert_eq!(self.matrix.len(), count * count);
    }

    /// The bounds with a part that is open.
    fn list_bounds<S: System<Scalar = T>>(&mut self, dynamics: &Dynamics<S>) {
        let d = S::DESCRIPTION;
        let acting = dynamics.acting_rows();
        let index = |row: usize| acting.binary_search(&row).ok();
        let number = |place: Place| dynamics.motion(place).value();
        let mode = dynamics.mode();
        let mut put = |guard: Guard, terms: [(usize, f64); 2], constant: f64| {
            let open = |j: usize| {
                let parts = terms.iter().map(|&(i, a)| a * self.freedom.row(i)[j]);
                parts.sum::<f64>().abs()
            };
            let most = (0..acting.len()).map(open).fold(0.0, f64::max);
            let coefficient = terms[0].1.abs().max(terms[1].1.abs());
            if most <= 1e-9 * coefficient {
                return;
            }
            let size = self.sizes.of(guard, dynamics).max(f64::MIN_POSITIVE);
            let value: f64 = terms.iter().map(|&(i, a)| a * self.least[i].value()).sum();
            self.bounds.push(Bound {
                guard,
                terms,
                size,
                value: (value + constant) / size,
            });
        };
        for (c, contact) in d.contacts.iter().enumerate() {
            if let Some(i) = index(contact.row) {
                put(Guard::Normal(c), [(i, 1.0), (i, 0.0)], 0.0);
            }
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            if mode.frictions[f] != FrictionMode::Stick || friction.components > 1 {
                continue;
            }
            let Some(i) = index(friction.row) else {
                continue;
            };
            let coefficient = number(friction.static_coefficient);
            let (normal, constant) = match friction.normal {
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
            put(Guard::StickUpper(f), [(i, -1.0), normal], constant);
            put(Guard::StickLower(f), [(i, 1.0), normal], constant);
        }
    }

    /// Whether a guard concerns forces that are not determined, so that by itself it decides nothing.
    pub fn is_open(&self, guard: Guard) -> bool {
        self.bounds.iter().any(|bound| bound.guard == guard)
    }

    /// Whether any guard does.
    pub fn has_open(&self) -> bool {
        !self.bounds.is_empty()
    }

    /// The joint guard that forbids the mode, or comes nearer to that than `margin` (relative).
    pub fn critical(&mut self, margin: f64) -> Option<Joint> {
        self.q.clear();
        let values = self.bounds.iter().map(|bound| bound.value - margin);
        self.q.extend(values);
        self.certificate()
    }

    /// The same for guards with other values than those looked at, and the same rows.
    pub fn critical_at(&mut self, mut value: impl FnMut(Guard) -> f64) -> Option<Joint> {
        self.q.clear();
        let values = self
            .bounds
            .iter()
            .map(|bound| value(bound.guard) / bound.size + ROUNDING);
        self.q.extend(values);
        self.certificate()
    }

    fn certificate(&mut self) -> Option<Joint> {
        if self.lemke.solve(&self.matrix, &self.q) != LemkeOutcome::Ray {
            return None;
        }
        let ray = self.lemke.ray();
        let sum: f64 = ray.iter().sum();
        let largest = ray.iter().copied().fold(0.0, f64::max);
        let weighted = self.bounds.iter().zip(ray);
        let parts = weighted.filter(|(_, w)| **w > 1e-9 * largest);
        Some(Joint {
            parts: parts
                .map(|(bound, w)| (bound.guard, w / (sum * bound.size)))
                .collect(),
        })
    }

    /// The forces of all rows at the last value of `dynamics`, and which of them are undetermined (nothing where all are
    /// determined).
    pub fn report<S: System<Scalar = T>>(
        &mut self,
        dynamics: &Dynamics<S>,
        undetermined: &mut Vec<bool>,
    ) -> Vec<T> {
        undetermined.clear();
        self.look(dynamics);
        if dynamics.has_dependent_rows() {
            self.undetermined(dynamics, undetermined);
        }
        self.forces(dynamics)
    }

    /// The forces of all rows: those of least norm within the bounds, if there are any within them.
    fn forces<S: System<Scalar = T>>(&mut self, dynamics: &Dynamics<S>) -> Vec<T> {
        if self.least.is_empty() {
            let rows = 0..S::DESCRIPTION.rows.len();
            return rows.map(|row| dynamics.force(row)).collect();
        }
        let mut forces = self.least.clone();
        // At its border a mode allows one share only, and rounding may take that away.
        let solved = [0.0, ROUNDING].into_iter().any(|slack| {
            self.q.clear();
            let values = self.bounds.iter().map(|bound| bound.value + slack);
            self.q.extend(values);
            self.lemke.solve(&self.matrix, &self.q) == LemkeOutcome::Solved
        });
        if solved {
            for (bound, &w) in self.bounds.iter().zip(self.lemke.z()) {
                for &(i, factor) in bound.terms.iter().filter(|_| w > 0.0) {
                    let change = self.freedom.row(i);
                    for (force, p) in forces.iter_mut().zip(change) {
                        *force += T::from_f64(w * factor / bound.size * p);
                    }
                }
            }
        }
        dynamics.forces_of_acting(&forces)
    }

    /// Whether the force of each row is undetermined.
    fn undetermined<S: System<Scalar = T>>(&self, dynamics: &Dynamics<S>, out: &mut Vec<bool>) {
        let d = S::DESCRIPTION;
        out.clear();
        out.resize(d.rows.len(), false);
        if self.least.is_empty() {
            return;
        }
        for (i, &row) in dynamics.acting_rows().iter().enumerate() {
            out[row] = !self.freedom.is_determined(i);
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            let source = match friction.normal {
                Normal::Contact(c) => d.contacts[c].row,
                Normal::Constraint(i) => d.constraints[i].row,
                Normal::Given(_) => continue,
            };
            if let FrictionMode::Slip(_) = dynamics.mode().frictions[f] {
                let open = out[source];
                out[friction.row..friction.row + friction.components].fill(open);
            }
        }
    }
}
