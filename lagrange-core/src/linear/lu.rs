//! LU factors with complete pivoting: P K Q = L U, rank-revealing.
//!
//! Reference: Golub & Van Loan 2013, Matrix Computations, section 3.4.9. The caller equilibrates; pivots are then
//! comparable with 1 and a pivot below [`NEGLIGIBLE`] means dependence.

use crate::arithmetic::{Scalar, epsilon};

/// Pivots of an equilibrated matrix below this (1e-12 in double precision) are dependence and not magnitude: rounding leaves
/// some N ε, and a genuinely smaller pivot would cost more than 12 of the 16 digits.
#[inline(always)]
pub(crate) fn negligible<T: Scalar>() -> f64 {
    4096.0 * epsilon::<T>()
}

/// The power of two near 1/√x by which a matrix is equilibrated without rounding; 1 for x = 0.
pub(super) fn inverse_root(x: f64) -> f64 {
    if x > 0.0 && x.is_finite() {
        (-0.5 * x.log2()).round().exp2()
    } else {
        1.0
    }
}

/// Σ xᵢ yᵢ
#[inline]
pub(crate) fn dot<T: Scalar>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::zero(), |sum, (&x, &y)| sum + x * y)
}

/// Numbers that are looked at side by side.
const WIDE: usize = 4;

/// The larger one; a NaN never is.
#[inline(always)]
fn larger(largest: f64, magnitude: f64) -> f64 {
    if magnitude > largest {
        magnitude
    } else {
        largest
    }
}

/// Largest magnitude.
fn largest<T: Scalar>(row: &[T]) -> f64 {
    let (blocks, rest) = row.as_chunks::<WIDE>();
    let mut largest = [0.0; WIDE];
    for block in blocks {
        for (largest, x) in largest.iter_mut().zip(block) {
            *largest = larger(*largest, x.value().abs());
        }
    }
    let rest = rest.iter().map(|x| x.value().abs());
    largest.into_iter().chain(rest).fold(0.0, larger)
}

/// Subtracts so many times another row; the largest magnitude that is left.
fn subtract<T: Scalar>(row: &mut [T], factor: T, other: &[T]) -> f64 {
    let (blocks, rest) = row.as_chunks_mut::<WIDE>();
    let (others, rest_of_other) = other.as_chunks::<WIDE>();
    let mut largest = [0.0; WIDE];
    for (block, other) in blocks.iter_mut().zip(others) {
        for ((largest, x), &y) in largest.iter_mut().zip(block).zip(other) {
            *x -= factor * y;
            *largest = larger(*largest, x.value().abs());
        }
    }
    let mut left = largest.into_iter().fold(0.0, larger);
    for (x, &y) in rest.iter_mut().zip(rest_of_other) {
        *x -= factor * y;
        left = larger(left, x.value().abs());
    }
    left
}

/// Factors of a square matrix; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lu<T> {
    size: usize,
    rank: usize,
    factors: Vec<T>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    /// While the matrix is factored: the largest magnitude in the remaining block of each row.
    largest: Vec<f64>,
    scratch: Vec<T>,
}

impl<T: Scalar> Lu<T> {
    /// Takes memory for matrices up to `size`.
    pub(crate) fn reserve(&mut self, size: usize) {
        self.factors.reserve(size * size);
        self.rows.reserve(size);
        self.columns.reserve(size);
        self.largest.reserve(size);
        self.scratch.reserve(size);
    }

    /// Number of pivots that are not negligible.
    pub(crate) fn rank(&self) -> usize {
        self.rank
    }

    /// The column of a pivot that was not found: an unknown that the equations do not determine.
    pub(crate) fn undetermined(&self) -> Option<usize> {
        self.columns.get(self.rank).copied()
    }

    /// Rows with a pivot: they span the others.
    pub(crate) fn independent_rows(&self) -> impl Iterator<Item = usize> + '_ {
        self.rows[..self.rank].iter().copied()
    }

    /// Rows without a pivot: linear combinations of the others.
    pub(crate) fn dependent_rows(&self) -> impl Iterator<Item = usize> + '_ {
        self.rows[self.rank..].iter().copied()
    }

    /// Gives each row without a pivot as a combination of those with one: the row, one of these, and its factor.
    pub(super) fn combine(&self, mut put: impl FnMut(usize, usize, T)) {
        let (size, rank) = (self.size, self.rank);
        let mut factors = vec![T::zero(); rank];
        for i in rank..size {
            // xᵀ L₁₁ = L₂₁, from the last.
            for k in (0..rank).rev() {
                let later = k + 1..rank;
                let sum = later.fold(T::zero(), |sum, j| {
                    sum + factors[j] * self.factors[j * size + k]
                });
                factors[k] = self.factors[i * size + k] - sum;
                put(self.rows[i], self.rows[k], factors[k]);
            }
        }
    }

    /// Factors the matrix whose rows `write` writes, each into zeros; stops at the rank. Pivots are found in the whole remaining block.
    pub(crate) fn factor(&mut self, size: usize, write: impl FnMut(usize, &mut [T])) {
        self.factor_to((negligible::<T>(), size), size, write);
    }

    /// [`Self::factor`] where pivots up to `least` are dependence, and those after the first `most` too.
    pub(super) fn factor_to(
        &mut self,
        (least, most): (f64, usize),
        size: usize,
        mut write: impl FnMut(usize, &mut [T]),
    ) {
        self.size = size;
        self.factors.clear();
        self.factors.resize(size * size, T::zero());
        let rows = self.factors.chunks_exact_mut(size.max(1));
        rows.enumerate().for_each(|(i, row)| write(i, row));
        self.rows.clear();
        self.rows.extend(0..size);
        self.columns.clear();
        self.columns.extend(0..size);
        self.scratch.clear();
        self.scratch.resize(size, T::zero());
        self.largest.clear();
        self.largest
            .extend(self.factors.chunks_exact(size.max(1)).map(largest));
        self.rank = size;
        for step in 0..size {
            let (mut largest, mut row) = (0.0, step);
            for (i, &magnitude) in self.largest.iter().enumerate().skip(step) {
                if magnitude > largest {
                    (largest, row) = (magnitude, i);
                }
            }
            // A NaN never wins the comparison; it shows in the solution.
            if largest <= least || step == most {
                self.rank = step;
                return;
            }
            let elements = &self.factors[row * size..(row + 1) * size];
            let is_pivot = |x: &T| x.value().abs() == largest;
            let column = elements[step..].iter().position(is_pivot);
            self.swap(step, row, step + column.unwrap_or(0));
            let (upper, lower) = self.factors.split_at_mut((step + 1) * size);
            let pivot_row = &upper[step * size..];
            let inverse = T::one() / pivot_row[step];
            let left = self.largest[step + 1..].iter_mut();
            for (row, left) in lower.chunks_exact_mut(size).zip(left) {
                if !row[step].is_zero() {
                    let factor = row[step] * inverse;
                    row[step] = factor;
                    *left = subtract(&mut row[step + 1..], factor, &pivot_row[step + 1..]);
                }
            }
        }
    }

    fn swap(&mut self, step: usize, row: usize, column: usize) {
        let size = self.size;
        if row != step {
            self.rows.swap(step, row);
            self.largest.swap(step, row);
            let (upper, lower) = self.factors.split_at_mut(row * size);
            upper[step * size..(step + 1) * size].swap_with_slice(&mut lower[..size]);
        }
        if column != step {
            self.columns.swap(step, column);
            for i in 0..size {
                self.factors.swap(i * size + step, i * size + column);
            }
        }
    }

    /// Replaces b by x, for a matrix of full rank.
    #[inline]
    pub(crate) fn solve(&mut self, b: &mut [T]) {
        self.solve_part(b);
    }

    /// Replaces b by x; unknowns without pivot become zero. Returns the largest residual of the equations without pivot.
    pub(crate) fn solve_part(&mut self, b: &mut [T]) -> f64 {
        let (size, rank) = (self.size, self.rank);
        for (y, &row) in self.scratch.iter_mut().zip(&self.rows) {
            *y = b[row];
        }
        for i in 1..size {
            let sum = dot(
                &self.factors[i * size..i * size + i.min(rank)],
                &self.scratch,
            );
            self.scratch[i] -= sum;
        }
        let mut left_out = 0.0;
        for y in &mut self.scratch[rank..] {
            left_out = f64::max(left_out, y.value().abs());
            *y = T::zero();
        }
        for i in (0..rank).rev() {
            let row = &self.factors[i * size..(i + 1) * size];
            let sum = dot(&row[i + 1..rank], &self.scratch[i + 1..]);
            self.scratch[i] = (self.scratch[i] - sum) / row[i];
        }
        for (&column, &y) in self.columns.iter().zip(&self.scratch) {
            b[column] = y;
        }
        left_out
    }
}
