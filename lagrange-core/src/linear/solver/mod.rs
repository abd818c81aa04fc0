//! Solves the constrained system: [`Direct`] where that is safe, else equilibrated
//! LU with complete pivoting, dependent rows set aside.

mod rows;
mod scaling;

use super::direct::Direct;
use super::lu::{Lu, dot};
use crate::arithmetic::Scalar;

/// What is wrong with a system; indices are unknowns and equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SolveError {
    /// The equations leave this unknown open.
    Undetermined { unknown: usize },
    /// The equation has an element that is not a finite number.
    NotFinite { equation: usize },
    /// This row depends on others and contradicts them.
    Inconsistent { row: usize, residual: f64 },
}

/// What is known of the upper left block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Inertia {
    /// Symmetric, and positive definite unless the system is degenerate.
    Symmetric,
    /// Nothing.
    General,
}

/// How rows that depend on one another share a load.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Shares {
    /// Nothing depends on it: those set aside carry nothing.
    #[default]
    Any,
    /// As equal springs below a rigid body do.
    Equal,
}

/// Which factors are current.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Factors {
    #[default]
    Direct,
    Complete,
    /// The same, with the rows set aside that were held.
    Held,
}

/// Four coordinates, and the row that keeps them at unit length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnitQuaternion {
    pub(crate) coordinates: [usize; 4],
    pub(crate) row: usize,
}

/// A factored system; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solver<T> {
    coordinates: usize,
    size: usize,
    matrix: Vec<T>,
    scale: Vec<f64>,
    /// Coordinates with hardly any inertia beside the others.
    light: Vec<bool>,
    quaternions: Vec<UnitQuaternion>,
    /// The matrix with Σ κ aᵀ a of the rows that keep quaternions at unit length.
    augmented: Vec<T>,
    /// The factors κ in it; none where it is not used.
    weights: Vec<T>,
    factors: Factors,
    direct: Direct<T>,
    lu: Lu<T>,
    /// Sizes of what was taken from the rows before, in the scale of inertia.
    taken: Vec<f64>,
    /// Rows set aside because they depend on the others.
    aside: Vec<bool>,
    /// Whether they stay aside, wherever the matrix is next.
    holds: bool,
    shared: Shares,
    /// What the force of each row is of those set aside, by these, with its sign changed; scaled.
    shares: Vec<T>,
    work: Vec<T>,
}

impl<T: Scalar> Solver<T> {
    /// Takes memory for systems of up to `coordinates + rows` equations.
    pub(crate) fn reserve(&mut self, coordinates: usize, rows: usize) {
        let size = coordinates + rows;
        self.matrix.reserve(size * size);
        self.scale.reserve(size);
        self.light.reserve(coordinates);
        self.taken.reserve(rows);
        self.aside.reserve(rows);
        self.shares.reserve(rows * rows);
        self.work.reserve(size);
        self.direct.reserve(size);
        self.lu.reserve(size);
        if !self.quaternions.is_empty() {
            self.augmented.reserve(size * size);
        }
    }

    /// Says which unknowns and equations are those of unit quaternions: their coordinates are of one kind, and have one scale. Close to an attitude in
    /// which one element is 1 this has no inertia of its own.
    pub(crate) fn set_quaternions(&mut self, quaternions: impl Iterator<Item = UnitQuaternion>) {
        self.quaternions.clear();
        self.quaternions.extend(quaternions);
    }

    /// The row-major matrix to be filled, set to `constant`.
    pub(crate) fn begin(&mut self, coordinates: usize, size: usize, constant: &[T]) -> &mut [T] {
        self.coordinates = coordinates;
        self.size = size;
        self.matrix.clear();
        self.matrix.extend_from_slice(constant);
        self.taken.clear();
        self.taken.resize(size - coordinates, 0.0);
        &mut self.matrix
    }

    /// Equation `row` had an element of this `size`, over the root of its inertia, before other rows were eliminated.
    pub(crate) fn note_taken(&mut self, row: usize, size: f64) {
        let taken = &mut self.taken[row - self.coordinates];
        *taken = taken.max(size);
    }

    /// Whether the factors are those that no scale and no choice of pivots was needed for: what rounding leaves of a solution is small beside the terms of each
    /// equation then.
    pub(crate) fn is_direct(&self) -> bool {
        self.factors == Factors::Direct
    }

    /// Whether a row was set aside.
    pub(crate) fn has_rows_aside(&self) -> bool {
        self.aside.contains(&true)
    }

    /// How many rows were set aside.
    pub(crate) fn rows_aside(&self) -> usize {
        self.aside.iter().filter(|aside| **aside).count()
    }

    /// Whether the rows that are aside now stay aside until this is said again.
    ///
    /// Rows that depend on others do so on the constraints only. A small way from them, at the end of a step, they seem to be independent,
    /// and their forces would be those that bring the state back at once.
    pub(crate) fn hold_rows_aside(&mut self, yes: bool) {
        self.holds = yes && self.has_rows_aside();
    }

    /// Sets no rows aside, as before the first matrix.
    pub(crate) fn forget_rows_aside(&mut self) {
        self.holds = false;
        self.aside.clear();
    }

    /// Whether rows are held aside.
    pub(crate) fn holds_rows_aside(&self) -> bool {
        self.holds
    }

    /// Whether row `i` of the system is held aside.
    pub(crate) fn holds_aside(&self, i: usize) -> bool {
        self.holds && self.aside[i]
    }

    /// Factors the matrix.
    pub(crate) fn factor(&mut self, inertia: Inertia, shared: Shares) -> Result<(), SolveError> {
        self.shared = shared;
        if self.holds && self.aside.len() == self.size - self.coordinates {
            self.equilibrate();
            if self.keeps_weak_rows() {
                self.choose_rows(0.0, self.aside.len() - self.rows_aside());
            }
            self.factor_kept();
            if self.lu.rank() == self.size {
                self.factors = Factors::Held;
                return Ok(());
            }
        }
        self.holds = false;
        self.aside.clear();
        self.augment(inertia);
        let leading = match inertia {
            Inertia::Symmetric => self.coordinates,
            Inertia::General => 0,
        };
        let matrix = match self.weights.is_empty() {
            true => &self.matrix,
            false => &self.augmented,
        };
        if self.direct.factor(leading, self.size, matrix) {
            self.factors = Factors::Direct;
            return Ok(());
        }
        self.factors = Factors::Complete;
        if let Some(bad) = self.matrix.iter().position(|x| !x.value().is_finite()) {
            return Err(SolveError::NotFinite {
                equation: bad / self.size,
            });
        }
        self.aside.resize(self.size - self.coordinates, false);
        self.equilibrate();
        self.factor_kept();
        if self.lu.rank() == self.size {
            return Ok(());
        }
        self.factor_independent(self.aside.len())
    }

    /// The same where no more than so many rows are independent, although more may seem to be.
    pub(crate) fn factor_dependent(&mut self, most: usize) -> Result<(), SolveError> {
        (self.shared, self.holds) = (Shares::Any, false);
        self.factors = Factors::Complete;
        self.aside.clear();
        self.aside.resize(self.size - self.coordinates, false);
        self.equilibrate();
        self.factor_independent(most)
    }

    /// LU of the scaled matrix, the equations of rows set aside replaced by λ = 0 or, where that has an effect, by those of
    /// [`Self::share`].
    fn factor_kept(&mut self) {
        let shared = self.shared == Shares::Equal && self.has_rows_aside();
        if shared {
            self.share();
        }
        let (n, size) = (self.coordinates, self.size);
        let (matrix, scale, aside) = (&self.matrix, &self.scale, &self.aside);
        let shares = &self.shares;
        let has_aside = aside.contains(&true);
        self.lu.factor(size, |i, row| {
            if i >= n && aside[i - n] {
                match shared {
                    true => row[n..].copy_from_slice(&shares[(i - n) * (size - n)..][..size - n]),
                    false => row[i] = T::one(),
                }
                return;
            }
            let elements = matrix[i * size..][..size].iter().zip(scale);
            for (x, (&element, by)) in row.iter_mut().zip(elements) {
                *x = element * T::from_f64(scale[i] * by);
            }
            if has_aside && !shared {
                let forces = row[n..].iter_mut().zip(aside);
                forces
                    .filter(|(_, aside)| **aside)
                    .for_each(|(x, _)| *x = T::zero());
            }
        });
    }

    /// Replaces the right-hand side by the solution.
    #[inline]
    pub(crate) fn solve(&mut self, b: &mut [T]) {
        match self.factors {
            Factors::Direct => {
                for (of, &weight) in self.quaternions.iter().zip(&self.weights) {
                    let load = weight * b[of.row];
                    for j in of.coordinates {
                        b[j] += self.matrix[of.row * self.size + j] * load;
                    }
                }
                self.direct.solve(b);
            }
            Factors::Complete | Factors::Held => self.solve_complete(b),
        }
    }

    fn solve_complete(&mut self, b: &mut [T]) {
        for (i, (b, &scale)) in b.iter_mut().zip(&self.scale).enumerate() {
            let kept = i < self.coordinates || !self.aside[i - self.coordinates];
            *b = if kept {
                *b * T::from_f64(scale)
            } else {
                T::zero()
            };
        }
        self.lu.solve(b);
        for (x, &scale) in b.iter_mut().zip(&self.scale) {
            *x *= T::from_f64(scale);
        }
    }

    /// One step of iterative refinement (Skeel 1980) of the solution `x`; of its right-hand side `b` remains the correction.
    ///
    /// The factors hold reciprocals of the pivots. A pivot that the motion keeps constant (the l² of a rod) has the same
    /// rounding error in all of them, and over very many steps a force that is always too large by half a unit in the last
    /// place shows. The rounding errors of the residual have no direction.
    pub(crate) fn refine(&mut self, x: &mut [T], b: &mut [T]) {
        for (b, row) in b.iter_mut().zip(self.matrix.chunks_exact(self.size.max(1))) {
            *b -= dot(row, x);
        }
        self.solve(b);
        for (x, &correction) in x.iter_mut().zip(&*b) {
            *x += correction;
        }
    }

    /// |K⁻¹| |K| |x| of the solution `x`, for each of the first unknowns as many as `open` has: what remains of them where the
    /// elements of the matrix are known to within a share, in units of that share (Skeel 1979, J. ACM 26; Higham 2002, section 7.2).
    pub(crate) fn open(&mut self, x: &[T], open: &mut [f64]) {
        let size = self.size;
        let sizes = self.matrix.chunks_exact(size.max(1)).map(|row| {
            let terms = row.iter().zip(x).map(|(a, x)| (*a * *x).value().abs());
            terms.sum()
        });
        let sizes: Vec<f64> = sizes.collect();
        let mut column = Vec::with_capacity(size);
        for (equation, terms) in sizes.iter().enumerate() {
            column.clear();
            column.resize(size, T::zero());
            column[equation] = T::one();
            self.solve(&mut column);
            for (open, x) in open.iter_mut().zip(&column) {
                *open += terms * x.value().abs();
            }
        }
    }
}
