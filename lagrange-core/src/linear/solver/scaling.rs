//! The scale of the system, and the weight of the rows of quaternions in it.
//!
//! Scaling is symmetric, K → D K D, by powers of two (exact): 1/√Mⱼⱼ for coordinates, so that inertia is about 1, then
//! each row of A to about 1. Pivots are then comparable with 1 whatever the units.

use super::{Inertia, Solver, UnitQuaternion};
use crate::arithmetic::{LIGHT, Scalar};
use crate::linear::lu::inverse_root;

/// A row that is so much smaller than another by what has inertia says nothing about it.
const NEARLY_NOTHING: f64 = 1e-6;

impl<T: Scalar> Solver<T> {
    /// Adds κ aᵀ (a v̇ + γ), which vanishes, to the equations of quaternions, whose inertia is singular along themselves: it is positive definite then, and
    /// the solution stays, forces included (augmented Lagrangian; Hestenes 1969, J. Optim. Theory Appl. 4, 303). κ = tr M / 12 makes that of a ball
    /// a multiple of 1.
    pub(super) fn augment(&mut self, inertia: Inertia) {
        self.weights.clear();
        if inertia == Inertia::General || self.quaternions.is_empty() {
            return;
        }
        self.augmented.clone_from(&self.matrix);
        let size = self.size;
        for &UnitQuaternion { coordinates, row } in &self.quaternions {
            let trace = coordinates
                .iter()
                .fold(T::zero(), |sum, &j| sum + self.matrix[j * size + j]);
            let weight = trace / T::from_f64(12.0);
            let a = &self.matrix[row * size..];
            for i in coordinates {
                for j in coordinates {
                    self.augmented[i * size + j] += weight * a[i] * a[j];
                }
            }
            self.weights.push(weight);
        }
    }

    pub(super) fn equilibrate(&mut self) {
        let (n, size) = (self.coordinates, self.size);
        self.find_light();
        self.scale.clear();
        let inertia = |j: usize| self.matrix[j * size + j].value().abs();
        let by_column = |j: usize| {
            let column = (0..size).map(|i| self.matrix[i * size + j].value().abs());
            let largest = column.fold(0.0, f64::max);
            inverse_root(largest * largest)
        };
        for j in 0..n {
            let mut quaternions = self.quaternions.iter().map(|of| of.coordinates);
            let of = quaternions.find(|of| of.contains(&j));
            let largest = of.map(|of| of.map(inertia).into_iter().fold(0.0, f64::max));
            let inertia = largest.unwrap_or_else(|| inertia(j));
            self.scale.push(match inertia > 0.0 {
                true if self.light[j] && of.is_none() => by_column(j),
                true => inverse_root(inertia),
                false => 0.0,
            });
        }
        // What has no inertia has that of what it moves with. In the place of the scale of a row stands how large it is by all that has some.
        let of_row = |row: usize, scale: &[f64]| {
            let scaled = self.matrix[row * size..][..n].iter().zip(scale);
            let sizes = scaled.map(|(x, scale)| x.value().abs() * scale);
            sizes.fold(0.0, f64::max)
        };
        for row in n..size {
            self.scale.push(of_row(row, &self.scale));
        }
        let rows = &self.scale[n..];
        let least = NEARLY_NOTHING * rows.iter().copied().fold(0.0, f64::max);
        for j in 0..n {
            if self.scale[j] > 0.0 {
                continue;
            }
            let element = |i: usize| self.matrix[i * size + j].value().abs();
            let rows = (n..size).filter(|&row| self.scale[row] > least);
            let largest = rows
                .map(|row| element(row) / self.scale[row])
                .fold(0.0, f64::max);
            self.scale[j] = match largest > 0.0 {
                true => inverse_root(largest * largest),
                false => by_column(j),
            };
        }
        for row in n..size {
            let largest = of_row(row, &self.scale);
            self.scale[row] = inverse_root(largest * largest);
        }
    }

    /// Finds the coordinates from which a row gets nearly all of its compliance Σ aₖ²/mₖ: scaled by such an inertia the others would
    /// vanish beside it. The others may vanish by themselves, as a crank does in its dead centre: they count with the longest arm that any row gives them.
    fn find_light(&mut self) {
        let (n, size) = (self.coordinates, self.size);
        self.light.clear();
        self.light.resize(n, false);
        let element = |i: usize, k: usize| self.matrix[i * size + k].value().abs();
        let arm = |k: usize| (n..size).map(|row| element(row, k)).fold(0.0, f64::max);
        for row in n..size {
            let moved = (0..n).filter(|&k| element(row, k) > 0.0);
            let compliance = |k: usize, arm: f64| arm * arm / element(k, k);
            let (mut most, mut of) = (0.0, n);
            for k in moved.clone() {
                let compliance = compliance(k, element(row, k));
                if compliance > most {
                    (most, of) = (compliance, k);
                }
            }
            let others = moved.filter(|&k| k != of);
            let near: f64 = others.clone().map(|k| compliance(k, element(row, k))).sum();
            let is_most = |others: f64| others > 0.0 && most > LIGHT * others;
            if is_most(near) && is_most(others.map(|k| compliance(k, arm(k))).sum()) {
                self.light[of] = true;
            }
        }
    }
}
