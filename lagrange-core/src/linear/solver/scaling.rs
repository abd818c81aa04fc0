//! The scale of the system, and the weight of the rows of quaternions in it.
//!
//! Scaling is symmetric, K → D K D, by powers of two (exact): 1/√Mⱼⱼ for coordinates, so that inertia is about 1, then
//! each row of A to about 1. Pivots are then comparable with 1 whatever the units.

use super::{Inertia, Solver, UnitQuaternion};
use crate::arithmetic::{LIGHT, Scalar};

/// A row that is so much smaller than another by what has inertia says nothing about it.
const NEARLY_NOTHING: f64 = 1e-6;

/// The power of two near 1/√x.
fn inverse_root(x: f64) -> f64 {
    if x > 0.0 && x.is_finite() {
        (-0.5 * x.log2()).round().exp2()
    } else {
        1.0
    }
}

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
    /// vanish beside it.
    fn find_light(&mut self) {
        let (n, size) = (self.coordinates, self.size);
        self.light.clear();
        self.light.resize(n, false);
        for row in self.matrix[n * size..].chunks_exact(size.max(1)) {
            let compliances = row[..n].iter().enumerate().filter(|(_, a)| !a.is_zero());
            let compliances = compliances.map(|(k, a)| {
                let inertia = self.matrix[k * size + k].value().abs();
                (k, a.value() * a.value() / inertia)
            });
            let (mut most, mut of) = (0.0, n);
            for (k, compliance) in compliances.clone() {
                if compliance > most {
                    (most, of) = (compliance, k);
                }
            }
            let others = compliances.filter(|&(k, _)| k != of);
            let others: f64 = others.map(|(_, compliance)| compliance).sum();
            if others > 0.0 && most > LIGHT * others {
                self.light[of] = true;
            }
        }
    }
}
