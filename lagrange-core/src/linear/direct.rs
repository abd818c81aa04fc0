//! LU factors of [M C; A 0] where M is symmetric and safely positive definite.
//!
//! Eliminating the accelerations needs no pivoting then (it is the LDLᵀ of M) and leaves the Schur complement −A M⁻¹ C of
//! the forces, which is factored with partial pivoting: with sliding friction it is not symmetric.
//! Reference: Golub & Van Loan 2013, Matrix Computations, sections 4.1.2 and 3.4.

use super::lu::NEGLIGIBLE;
use crate::arithmetic::Scalar;

/// A pivot of M below this share of its diagonal element has lost 10 of 16 digits: M is not safely positive definite.
const SAFE: f64 = 1e-10;

/// Factors of a system; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct Direct<T> {
    free: usize,
    size: usize,
    factors: Vec<T>,
    /// 1 / pivot.
    inverses: Vec<T>,
    /// Order of the rows of the Schur complement.
    rows: Vec<usize>,
    sizes: Vec<f64>,
    scratch: Vec<T>,
}

impl<T: Scalar> Direct<T> {
    /// Takes memory for systems of up to `free` accelerations and `forces` forces.
    pub(crate) fn reserve(&mut self, free: usize, forces: usize) {
        let size = free + forces;
        self.factors.reserve(size * size);
        self.inverses.reserve(size);
        self.rows.reserve(forces);
        self.sizes.reserve(forces);
        self.scratch.reserve(forces);
    }

    /// Factors the row-major `matrix`; false if that is not safe.
    pub(crate) fn factor(&mut self, free: usize, size: usize, matrix: &[T]) -> bool {
        (self.free, self.size) = (free, size);
        self.factors.clear();
        self.factors.extend_from_slice(matrix);
        self.inverses.clear();
        for step in 0..free {
            let diagonal = matrix[step * size + step].value();
            // Not "<=": a NaN is not safe either.
            if !(self.factors[step * size + step].value() > SAFE * diagonal && diagonal > 0.0) {
                return false;
            }
            self.eliminate(step);
        }
        self.rows.clear();
        self.rows.extend(free..size);
        self.sizes.clear();
        for row in free..size {
            let row = &self.factors[row * size + free..(row + 1) * size];
            self.sizes
                .push(row.iter().map(|x| x.value().abs()).fold(0.0, f64::max));
        }
        for step in free..size {
            let (mut best, mut pivot) = (0.0, step);
            for row in step..size {
                let share = self.factors[row * size + step].value().abs() / self.sizes[row - free];
                if share > best {
                    (best, pivot) = (share, row);
                }
            }
            if !(best > NEGLIGIBLE) {
                return false;
            }
            if pivot != step {
                self.rows.swap(step - free, pivot - free);
                self.sizes.swap(step - free, pivot - free);
                let (upper, lower) = self.factors.split_at_mut(pivot * size);
                upper[step * size..(step + 1) * size].swap_with_slice(&mut lower[..size]);
            }
            self.eliminate(step);
        }
        self.scratch.clear();
        self.scratch.resize(size - free, T::zero());
        true
    }

    /// Takes column `step` out of the rows below.
    #[inline]
    fn eliminate(&mut self, step: usize) {
        let size = self.size;
        let (upper, lower) = self.factors.split_at_mut((step + 1) * size);
        let pivot_row = &upper[step * size..];
        let inverse = T::one() / pivot_row[step];
        self.inverses.push(inverse);
        for row in lower.chunks_exact_mut(size) {
            if row[step].is_zero() {
                continue;
            }
            let factor = row[step] * inverse;
            row[step] = factor;
            for (x, &p) in row[step + 1..].iter_mut().zip(&pivot_row[step + 1..]) {
                *x -= factor * p;
            }
        }
    }

    /// Replaces b by the solution.
    #[inline]
    pub(crate) fn solve(&mut self, b: &mut [T]) {
        let (free, size) = (self.free, self.size);
        if size - free > 1 {
            for (y, &row) in self.scratch.iter_mut().zip(&self.rows) {
                *y = b[row];
            }
            b[free..].copy_from_slice(&self.scratch);
        }
        for (i, row) in self.factors.chunks_exact(size.max(1)).enumerate().skip(1) {
            let (solved, open) = b.split_at_mut(i);
            open[0] -= dot(&row[..i], solved);
        }
        for (i, row) in self.factors.chunks_exact(size.max(1)).enumerate().rev() {
            let (open, solved) = b.split_at_mut(i + 1);
            open[i] = (open[i] - dot(&row[i + 1..], solved)) * self.inverses[i];
        }
    }
}

#[inline]
pub(super) fn dot<T: Scalar>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::zero(), |sum, (&x, &y)| sum + x * y)
}
