//! LU factors of [M C; A 0] where that is safe without much ado.
//!
//! Where M is symmetric and positive definite, eliminating the accelerations needs no pivoting (it is the LDLᵀ of M) and
//! leaves the Schur complement −A M⁻¹ C of the forces, which is factored with partial pivoting in rows scaled to 1: with
//! sliding friction it is not symmetric. Where M is not symmetric the whole is factored in that way.
//! Reference: Golub & Van Loan 2013, Matrix Computations, sections 4.1.2 and 3.4.

use super::lu::{dot, negligible};
use crate::arithmetic::{Scalar, is_spread, positive_definite};

/// Factors of a system; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct Direct<T> {
    /// Number of leading pivots that are taken as they come.
    leading: usize,
    size: usize,
    factors: Vec<T>,
    /// 1 / pivot.
    inverses: Vec<T>,
    /// What rounding took from the inverses of the pivots of the forces.
    ///
    /// A pivot that the motion keeps constant (the l² of a rod) has the same rounding error in every solve. A force that is
    /// always too large by half a unit in the last place shows over very many steps.
    lost: Vec<T>,
    /// Per row of the factors: where its first element is that is not zero, and where its last one ends. Masses that know
    /// only their neighbours, or none, leave most of a large matrix empty.
    filled: Vec<(usize, usize)>,
    /// Order of the rows of the Schur complement.
    rows: Vec<usize>,
    sizes: Vec<f64>,
    scratch: Vec<T>,
}

impl<T: Scalar> Direct<T> {
    /// Takes memory for systems of up to `size` equations.
    pub(crate) fn reserve(&mut self, size: usize) {
        self.factors.reserve(size * size);
        self.inverses.reserve(size);
        self.lost.reserve(size);
        self.filled.reserve(size);
        self.rows.reserve(size);
        self.sizes.reserve(size);
        self.scratch.reserve(size);
    }

    /// Factors the row-major `matrix`, whose first `leading` rows and columns are symmetric and should be positive
    /// definite; false if that is not safe.
    pub(crate) fn factor(&mut self, leading: usize, size: usize, matrix: &[T]) -> bool {
        (self.leading, self.size) = (leading, size);
        self.factors.clear();
        self.factors.extend_from_slice(matrix);
        self.inverses.clear();
        self.lost.clear();
        // Least share that a pivot before has had of its diagonal element.
        let mut least: f64 = 1.0;
        for step in 0..leading {
            let diagonal = matrix[step * size + step].value();
            let pivot = self.factors[step * size + step].value();
            // Not "<=": a NaN is not safe either.
            if !(least * pivot > positive_definite::<T>() * diagonal && diagonal > 0.0) {
                return false;
            }
            least = least.min(pivot / diagonal);
            self.eliminate_symmetric(step);
        }
        if !(leading..size).all(|row| self.is_spread(row)) {
            return false;
        }
        self.rows.clear();
        self.rows.extend(leading..size);
        self.sizes.clear();
        for row in leading..size {
            let row = &self.factors[row * size + leading..(row + 1) * size];
            self.sizes
                .push(row.iter().map(|x| x.value().abs()).fold(0.0, f64::max));
        }
        for step in leading..size {
            let (mut best, mut pivot) = (0.0, step);
            for row in step..size {
                let share =
                    self.factors[row * size + step].value().abs() / self.sizes[row - leading];
                if share > best {
                    (best, pivot) = (share, row);
                }
            }
            if !(best > negligible::<T>()) {
                return false;
            }
            if pivot != step {
                self.rows.swap(step - leading, pivot - leading);
                self.sizes.swap(step - leading, pivot - leading);
                let (upper, lower) = self.factors.split_at_mut(pivot * size);
                upper[step * size..(step + 1) * size].swap_with_slice(&mut lower[..size]);
            }
            self.eliminate(step);
        }
        self.scratch.clear();
        self.scratch.resize(size - leading, T::zero());
        self.filled.clear();
        let rows = self.factors.chunks_exact(size.max(1)).enumerate();
        self.filled.extend(rows.map(|(i, row)| {
            // Full rows are found out at once. Below the diagonal of the symmetric block stand the factors.
            let first = row[..i].iter().position(|x| !x.is_zero());
            let last = row[i + 1..].iter().rposition(|x| !x.is_zero());
            (first.unwrap_or(i), last.map_or(i + 1, |last| i + 2 + last))
        }));
        true
    }

    /// Whether the compliance of `row` of A, Σ lₖ² dₖ, comes from more than one pivot dₖ of M.
    fn is_spread(&self, row: usize) -> bool {
        let factors = self.factors[row * self.size..].iter();
        let parts = factors.zip(&self.inverses).map(|(l, inverse)| {
            let l = l.value();
            l * l / inverse.value()
        });
        is_spread(core::iter::empty(), parts)
    }

    /// Takes column `step` of the symmetric block out of the rows below; of that block only the upper triangle is kept.
    #[inline]
    fn eliminate_symmetric(&mut self, step: usize) {
        let (size, leading) = (self.size, self.leading);
        let (upper, lower) = self.factors.split_at_mut((step + 1) * size);
        let pivot_row = &upper[step * size..];
        let inverse = T::one() / pivot_row[step];
        self.inverses.push(inverse);
        for (row, i) in lower.chunks_exact_mut(size).zip(step + 1..) {
            let (element, first) = if i < leading {
                (pivot_row[i], i)
            } else {
                (row[step], step + 1)
            };
            if element.is_zero() {
                row[step] = element;
                continue;
            }
            let factor = element * inverse;
            row[step] = factor;
            for (x, &p) in row[first..].iter_mut().zip(&pivot_row[first..]) {
                *x -= factor * p;
            }
        }
    }

    /// Takes column `step` out of the rows below.
    #[inline]
    fn eliminate(&mut self, step: usize) {
        let size = self.size;
        let (upper, lower) = self.factors.split_at_mut((step + 1) * size);
        let pivot_row = &upper[step * size..];
        let inverse = T::one() / pivot_row[step];
        self.inverses.push(inverse);
        let (pivot, rounded) = (pivot_row[step].value(), inverse.value());
        let residual = (-pivot).mul_add(rounded, 1.0);
        self.lost.push(T::from_f64(residual * rounded));
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
        if self.size - self.leading > 1 {
            for (y, &row) in self.scratch.iter_mut().zip(&self.rows) {
                *y = b[row];
            }
            b[self.leading..].copy_from_slice(&self.scratch);
        }
        // Most systems are this small once constant rows are eliminated.
        match self.size {
            1 if self.leading == 1 => b[0] *= self.inverses[0],
            1 => b[0] = b[0] * self.inverses[0] + b[0] * self.lost[0],
            2 => self.substitute_fixed::<2>(b),
            3 => self.substitute_fixed::<3>(b),
            4 => self.substitute_fixed::<4>(b),
            _ => self.substitute(b),
        }
    }

    /// [`Self::substitute`] with loops of a length that the compiler knows.
    #[inline]
    fn substitute_fixed<const N: usize>(&self, b: &mut [T]) {
        let (rows, _) = self.factors.as_chunks::<N>();
        let (Ok(rows), Ok(inverses), Ok(b)) = (
            <&[[T; N]; N]>::try_from(rows),
            <&[T; N]>::try_from(&self.inverses[..]),
            <&mut [T; N]>::try_from(&mut *b),
        ) else {
            return self.substitute(b);
        };
        for i in 1..N {
            for j in 0..i {
                b[i] -= rows[i][j] * b[j];
            }
        }
        for i in (0..N).rev() {
            for j in i + 1..N {
                b[i] -= rows[i][j] * b[j];
            }
            let scaled = b[i] * inverses[i];
            b[i] = match i.checked_sub(self.leading) {
                Some(force) => scaled + b[i] * self.lost[force],
                None => scaled,
            };
        }
    }

    /// L y = b, U x = y.
    fn substitute(&self, b: &mut [T]) {
        let size = self.size.max(1);
        let rows = self.factors.chunks_exact(size).zip(&self.filled);
        for (i, (row, &(first, _))) in rows.clone().enumerate() {
            let (solved, open) = b.split_at_mut(i);
            open[0] -= dot(&row[first..i], &solved[first..]);
        }
        for (i, (row, &(_, last))) in rows.enumerate().rev() {
            let (open, solved) = b.split_at_mut(i + 1);
            let y = open[i] - dot(&row[i + 1..last], solved);
            open[i] = y * self.inverses[i];
            if let Some(force) = i.checked_sub(self.leading) {
                open[i] += y * self.lost[force];
            }
        }
    }
}
