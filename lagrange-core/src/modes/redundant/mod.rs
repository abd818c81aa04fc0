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
//! which everything open cancels, and which is negative. Such a sum is a [`CompositeGuard`] guard. It ends a mode where the guards
//! of single forces cannot: both frictions under a rod slip together, where μs (N₁ + N₂) − (F₁ + F₂) falls through zero.

mod bounds;
mod composite;

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::linear::{Freedom, Lemke, LemkeOutcome};
use crate::mode::FrictionMode;
use crate::modes::guard::Guard;
use crate::modes::scale::Sizes;
use crate::system::Normal;
use bounds::{Bound, Cone};
pub use composite::{CompositeGuard, ONES, Part, series, side, value};

/// Undetermined forces at one state; the memory is reused.
#[derive(Clone, Debug, Default)]
pub struct RedundantForces<T> {
    least: Vec<T>,
    freedom: Freedom,
    bounds: Vec<Bound>,
    cones: Vec<Cone>,
    /// G P Gᵀ
    matrix: Vec<f64>,
    q: Vec<f64>,
    /// Forces of the rows that act, as found last.
    shares: Vec<f64>,
    sizes: Sizes,
    lemke: Lemke,
}

/// What rounding leaves of a bound, relative to its size.
const ROUNDING: f64 = 1e-10;

/// A force this far outside its cone, relative, is in it.
const CONE: f64 = 1e-14;

/// Cones are cut by so many sets of planes at most; they settle quadratically.
const MOST_CUTS: usize = 40;

impl<T: Scalar> RedundantForces<T> {
    /// Forgets everything: all forces are determined.
    pub fn clear(&mut self) {
        self.bounds.clear();
        self.cones.clear();
        self.least.clear();
    }

    /// Looks at the last value of `dynamics`.
    pub fn look(&mut self, dynamics: &Dynamics<T>) {
        self.clear();
        if !dynamics.has_dependent_rows() {
            return;
        }
        (self.least, self.freedom) = dynamics.least_norm_of_acting();
        self.sizes.take(dynamics);
        self.list_bounds(dynamics);
        for index in 0..self.cones.len() {
            for along in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
                self.cut(index, along);
            }
        }
        self.fill_matrix();
    }

    fn fill_matrix(&mut self) {
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
    }

    /// Whether a guard concerns forces that are not determined, so that by itself it decides nothing.
    pub fn is_open(&self, guard: Guard) -> bool {
        self.bounds.iter().any(|bound| bound.guard == guard)
    }

    /// Whether any guard does.
    pub fn has_open(&self) -> bool {
        !self.bounds.is_empty()
    }

    /// The composite guard that forbids the mode, or comes nearer to that than `margin` (relative): of all the smallest.
    ///
    /// Each guard found bounds the margin that all bounds together can keep; looking again at that margin finds a smaller one,
    /// or that there is none (Dinkelbach 1967, Management Science 13, 492).
    pub fn critical(&mut self, mut margin: f64) -> Option<CompositeGuard> {
        let mut smallest = None;
        for _ in 0..MOST_CUTS {
            if self.find_shares(margin) {
                break;
            }
            let Some((composite, value)) = self.certificate() else {
                break;
            };
            smallest = Some(composite);
            // Below that the search sees its own rounding.
            if value > margin - ROUNDING {
                break;
            }
            margin = value;
        }
        smallest
    }

    /// The same for guards with other values than those looked at, and the same rows.
    pub fn critical_at(
        &mut self,
        mut value: impl FnMut(Guard, [f64; 2]) -> f64,
    ) -> Option<CompositeGuard> {
        self.q.clear();
        let values = self
            .bounds
            .iter()
            .map(|bound| value(bound.guard, bound.along) / bound.size + ROUNDING);
        self.q.extend(values);
        let forbids = self.lemke.solve(&self.matrix, &self.q) == LemkeOutcome::Ray;
        let (composite, _) = forbids.then(|| self.certificate())??;
        Some(composite)
    }

    /// The composite guard that the last search, which has failed, ended with, and its value at the forces looked at.
    fn certificate(&self) -> Option<(CompositeGuard, f64)> {
        let ray = self.lemke.ray();
        let sum: f64 = ray.iter().sum();
        if sum <= 0.0 {
            return None;
        }
        let largest = ray.iter().copied().fold(0.0, f64::max);
        let weighted = self.bounds.iter().zip(ray);
        let parts = weighted.filter(|(_, w)| **w > 1e-9 * largest);
        let value = parts.clone().map(|(bound, w)| w / sum * bound.value).sum();
        let composite = CompositeGuard {
            parts: parts
                .map(|(bound, w)| Part {
                    guard: bound.guard,
                    along: bound.along,
                    weight: w / (sum * bound.size),
                })
                .collect(),
        };
        Some((composite, value))
    }

    /// Finds the shares of least norm that keep all bounds by `margin`, into `self.shares`; cones are cut where they are
    /// left, until none is. False: there are none.
    fn find_shares(&mut self, margin: f64) -> bool {
        for _ in 0..MOST_CUTS {
            self.q.clear();
            let values = self.bounds.iter().map(|bound| bound.value - margin);
            self.q.extend(values);
            if self.lemke.solve(&self.matrix, &self.q) != LemkeOutcome::Solved {
                return false;
            }
            self.shares.clear();
            self.shares.extend(self.least.iter().map(|x| x.value()));
            for (bound, &w) in self.bounds.iter().zip(self.lemke.z()) {
                for &(i, factor) in bound.terms.iter().filter(|_| w > 0.0) {
                    let change = self.freedom.row(i).iter();
                    for (force, p) in self.shares.iter_mut().zip(change) {
                        *force += w * factor / bound.size * p;
                    }
                }
            }
            let mut settled = true;
            for index in 0..self.cones.len() {
                let cone = self.cones[index];
                let [x, y] = cone.rows.map(|i| self.shares[i]);
                let holds = cone.limit.1 * self.shares[cone.limit.0] + cone.constant;
                let force = x.hypot(y);
                if force > 0.0 && force - holds > (CONE - margin) * cone.size {
                    self.cut(index, [x / force, y / force]);
                    settled = false;
                }
            }
            if settled {
                return true;
            }
            self.fill_matrix();
        }
        true
    }

    /// The forces of all rows at the last value of `dynamics`, and which of them are undetermined (nothing where all are
    /// determined).
    pub fn report(&mut self, dynamics: &Dynamics<T>, undetermined: &mut Vec<bool>) -> Vec<T> {
        undetermined.clear();
        self.look(dynamics);
        if dynamics.has_dependent_rows() {
            self.undetermined(dynamics, undetermined);
        }
        self.forces(dynamics)
    }

    /// The forces of all rows: those of least norm within the bounds, if there are any within them.
    fn forces(&mut self, dynamics: &Dynamics<T>) -> Vec<T> {
        if self.least.is_empty() {
            let rows = 0..dynamics.description().rows.len();
            return rows.map(|row| dynamics.force(row)).collect();
        }
        let mut forces = self.least.clone();
        // At its border a mode allows one share only, and rounding may take that away.
        if self.has_open() && [0.0, -ROUNDING].into_iter().any(|m| self.find_shares(m)) {
            for (force, &share) in forces.iter_mut().zip(&self.shares) {
                let change = share - force.value();
                if change != 0.0 {
                    *force += T::from_f64(change);
                }
            }
        }
        dynamics.forces_of_acting(&forces)
    }

    /// Whether the force of each row is undetermined.
    fn undetermined(&self, dynamics: &Dynamics<T>, out: &mut Vec<bool>) {
        let d = dynamics.description();
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
