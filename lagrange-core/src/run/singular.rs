//! Isolated positions where constraints lose rank: a linkage in its dead position.
//!
//! The motion goes smoothly through such a position, but the equations cannot be solved there, and close to it rounding is
//! amplified by the inverse of the distance. A Taylor polynomial from some way before it is good beyond it: a step must
//! only not *end* close to it.
//!
//! How close is read from the pivots of G = A D⁻¹ Aᵀ (A the rows of constraints, D the diagonal of the mass matrix) in
//! Cholesky's factorization with complete pivoting: the smallest of them that is not always zero, over its largest value
//! so far, is the square of a distance.

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::system::{Place, System};

/// A pivot below this share of the first has always been zero: its row depends on others everywhere.
const DEPENDENT: f64 = 1e-10;

/// Watches the rank of the constraints along a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Rank {
    /// Rows that may lose rank; none: nothing to watch.
    rows: Vec<usize>,
    gram: Vec<f64>,
    pivots: Vec<f64>,
    /// Largest value of each pivot so far.
    largest: Vec<f64>,
    weights: Vec<f64>,
    scaled: Vec<f64>,
}

impl Rank {
    /// Watches the constraints whose Jacobian depends on the state and that act at all times.
    pub(super) fn new<S: System>() -> Self {
        let d = S::DESCRIPTION;
        let n = d.coordinates.len();
        let changes = |row: usize| {
            let jacobian = d.rows[row].jacobian.iter();
            jacobian.clone().any(|(_, place)| matches!(place, Place::Node(_)))
        };
        let constraints = d.constraints.iter().filter(|c| c.while_contact.is_none());
        let mut rows: Vec<usize> = constraints.map(|c| c.row).collect();
        // A row that is constant cannot lose rank alone, but one that is not may come to depend on it.
        if !rows.iter().any(|&row| changes(row)) {
            rows.clear();
        }
        let m = rows.len();
        Rank {
            gram: vec![0.0; m * m],
            pivots: vec![0.0; m],
            largest: vec![0.0; m],
            weights: vec![1.0; n],
            scaled: vec![0.0; m * n],
            rows,
        }
    }

    /// Distance of the state that `dynamics` has evaluated from a loss of rank, 1 at the farthest so far.
    pub(super) fn distance<S: System>(&mut self, dynamics: &Dynamics<S>) -> f64 {
        if self.rows.is_empty() {
            return 1.0;
        }
        self.fill(dynamics);
        self.eliminate();
        let mut nearest: f64 = 1.0;
        for (largest, pivot) in self.largest.iter_mut().zip(&self.pivots) {
            *largest = largest.max(*pivot);
        }
        let first = self.largest[0];
        for (largest, pivot) in self.largest.iter().zip(&self.pivots) {
            if *largest > DEPENDENT * first {
                nearest = nearest.min((pivot / largest).max(0.0).sqrt());
            }
        }
        nearest
    }

    fn fill<S: System>(&mut self, dynamics: &Dynamics<S>) {
        let d = S::DESCRIPTION;
        let n = d.coordinates.len();
        let number = |place: Place| dynamics.motion(place).value();
        for &(i, j, place) in d.mass {
            let mass = number(place);
            if i == j && mass > 0.0 {
                self.weights[i] = 1.0 / mass.sqrt();
            }
        }
        self.scaled.fill(0.0);
        let m = self.rows.len();
        for (k, &row) in self.rows.iter().enumerate() {
            for &(j, place) in d.rows[row].jacobian {
                self.scaled[k * n + j] = number(place) * self.weights[j];
            }
        }
        for i in 0..m {
            for j in 0..m {
                let pair = (0..n).map(|k| self.scaled[i * n + k] * self.scaled[j * n + k]);
                self.gram[i * m + j] = pair.sum();
            }
        }
    }

    /// Pivots of the Gram matrix, descending.
    fn eliminate(&mut self) {
        let m = self.rows.len();
        self.pivots.fill(0.0);
        for step in 0..m {
            let best = (step..m).max_by(|&a, &b| {
                self.gram[a * m + a].total_cmp(&self.gram[b * m + b])
            });
            let best = best.unwrap_or(step);
            for k in 0..m {
                self.gram.swap(step * m + k, best * m + k);
            }
            for k in 0..m {
                self.gram.swap(k * m + step, k * m + best);
            }
            let pivot = self.gram[step * m + step];
            if !(pivot > 0.0) {
                break;
            }
            self.pivots[step] = pivot;
            for i in step + 1..m {
                let factor = self.gram[i * m + step] / pivot;
                for j in step + 1..m {
                    self.gram[i * m + j] -= factor * self.gram[step * m + j];
                }
            }
        }
    }
}
