//! LU factors with partial pivoting, for the Newton iterations of implicit methods.
//!
//! The matrix is made of numbers, since an approximate one does; right-hand sides are of the run's own scalar.

use crate::arithmetic::Scalar;

/// Factors of a square matrix (row-major, L below the diagonal) and the rows that were exchanged.
#[derive(Clone, Debug)]
pub(super) struct Factors {
    size: usize,
    entries: Vec<f64>,
    exchanged: Vec<usize>,
}

impl Factors {
    /// Room for matrices of `size` rows.
    pub fn new(size: usize) -> Self {
        Self {
            size,
            entries: vec![0.0; size * size],
            exchanged: vec![0; size],
        }
    }

    /// The matrix, to be written before [`Self::factor`].
    pub fn entries(&mut self) -> &mut [f64] {
        &mut self.entries
    }

    /// Factors what is in [`Self::entries`]; false if it is singular or not finite.
    pub fn factor(&mut self) -> bool {
        let n = self.size;
        for k in 0..n {
            let (mut pivot, mut largest) = (k, 0.0);
            for i in k..n {
                let size = self.entries[i * n + k].abs();
                if size > largest {
                    (pivot, largest) = (i, size);
                }
            }
            if largest == 0.0 || !largest.is_finite() {
                return false;
            }
            self.exchanged[k] = pivot;
            if pivot != k {
                for j in 0..n {
                    self.entries.swap(k * n + j, pivot * n + j);
                }
            }
            let (upper, lower) = self.entries.split_at_mut((k + 1) * n);
            let row = &upper[k * n..];
            let inverse = 1.0 / row[k];
            for below in lower.chunks_exact_mut(n) {
                let factor = below[k] * inverse;
                below[k] = factor;
                for (x, y) in below[k + 1..].iter_mut().zip(&row[k + 1..]) {
                    *x -= factor * y;
                }
            }
        }
        true
    }

    /// Replaces `b` by the solution.
    pub fn solve<T: Scalar>(&self, b: &mut [T]) {
        let n = self.size;
        for (k, &pivot) in self.exchanged.iter().enumerate() {
            b.swap(k, pivot);
        }
        for i in 0..n {
            let (known, rest) = b.split_at_mut(i);
            let row = &self.entries[i * n..];
            for (l, x) in row.iter().zip(known) {
                rest[0] -= T::from_f64(*l) * *x;
            }
        }
        for i in (0..n).rev() {
            let (rest, known) = b.split_at_mut(i + 1);
            let row = &self.entries[i * n..][..n];
            for (u, x) in row[i + 1..].iter().zip(known) {
                rest[i] -= T::from_f64(*u) * *x;
            }
            rest[i] /= T::from_f64(row[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Factors;

    #[test]
    fn a_system_that_needs_exchanges() {
        let mut factors = Factors::new(3);
        factors
            .entries()
            .copy_from_slice(&[0.0, 2.0, 1.0, 1.0, 0.0, 0.0, 4.0, 1.0, 3.0]);
        assert!(factors.factor());
        let mut b = [7.0, 1.0, 15.0];
        factors.solve(&mut b);
        for (x, exact) in b.iter().zip([1.0_f64, 2.0, 3.0]) {
            assert!((x - exact).abs() < 1e-15, "{b:?}");
        }
    }

    #[test]
    fn singular_matrices_are_refused() {
        let mut factors = Factors::new(2);
        factors.entries().copy_from_slice(&[1.0, 2.0, 2.0, 4.0]);
        assert!(!factors.factor());
        factors.entries().copy_from_slice(&[f64::NAN; 4]);
        assert!(!factors.factor());
    }
}
