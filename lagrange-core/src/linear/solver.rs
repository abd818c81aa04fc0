//! Solves the constrained system: [`Direct`] where that is safe, else equilibrated
//! LU with complete pivoting, dependent rows set aside.
//!
//! Scaling is symmetric, K → D K D, by powers of two (exact): 1/√Mⱼⱼ for coordinates, so that inertia is about 1, then
//! each row of A to about 1. Pivots are then comparable with 1 whatever the units.

use super::direct::Direct;
use super::lu::{Lu, dot, negligible};
use crate::arithmetic::{LIGHT, Scalar, epsilon};

/// A dependent row may miss its acceleration bias by this fraction of the largest term (1e-7 in double precision); rounding
/// and tolerated drift from the constraints stay below.
fn consistent<T: Scalar>() -> f64 {
    6.0 * epsilon::<T>().sqrt()
}

/// Among dependent rows one of which little is left is chosen last. It counts by this much at least, or it would seem to depend on the
/// others where it does not.
const LITTLE: f64 = 1e-4;

/// A row of which there is less than this beside one that is held aside loses digits that the other one keeps; it is not exchanged for less,
/// because off the constraints, where a state is to the tolerance, accelerations by one row are not quite those by the other.
const WEAK: f64 = 0.03;

/// Rows that have been set aside count by this when the others are factored (2⁻⁴⁰), so that none of them is among these,
const LAST: f64 = NEXT_TO_LAST / 1024.0;

/// whose pivots are larger than this.
const NEXT_TO_LAST: f64 = 1.0 / 1073741824.0;

/// More than this times what rounding leaves of a number is no rounding.
const BESIDE_ROUNDING: f64 = 1e4;

/// Accelerations of this size are none.
const SQUARE_OF_ROUNDING: f64 = 1e-20;

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
    /// The matrix with Σ κ aᵀ a of the rows that keep quaternions at unit length,
    augmented: Vec<T>,
    /// and these κ; none where it is not used.
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

/// The power of two near 1/√x.
fn inverse_root(x: f64) -> f64 {
    if x > 0.0 && x.is_finite() {
        (-0.5 * x.log2()).round().exp2()
    } else {
        1.0
    }
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

    /// Factors the equilibrated matrix with the rows of an independent subset.
    fn factor_independent(&mut self, most: usize) -> Result<(), SolveError> {
        self.choose_rows(negligible::<T>().sqrt(), most);
        self.factor_kept();
        match self.lu.undetermined() {
            Some(unknown) => Err(SolveError::Undetermined { unknown }),
            None => Ok(()),
        }
    }

    /// Adds κ aᵀ (a v̇ + γ), which vanishes, to the equations of quaternions, whose inertia is singular along themselves: it is positive definite then, and
    /// the solution stays, forces included (augmented Lagrangian; Hestenes 1969, J. Optim. Theory Appl. 4, 303). κ = tr M / 12 makes that of a ball
    /// a multiple of 1.
    fn augment(&mut self, inertia: Inertia) {
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

    fn equilibrate(&mut self) {
        let (n, size) = (self.coordinates, self.size);
        self.find_light();
        self.scale.clear();
        let inertia = |j: usize| self.matrix[j * size + j].value().abs();
        for j in 0..n {
            let mut quaternions = self.quaternions.iter().map(|of| of.coordinates);
            let of = quaternions.find(|of| of.contains(&j));
            let largest = of.map(|of| of.map(inertia).into_iter().fold(0.0, f64::max));
            let inertia = largest.unwrap_or_else(|| inertia(j));
            self.scale
                .push(if inertia > 0.0 && (of.is_some() || !self.light[j]) {
                    inverse_root(inertia)
                } else {
                    let column = (0..size).map(|i| self.matrix[i * size + j].value().abs());
                    let largest = column.fold(0.0, f64::max);
                    inverse_root(largest * largest)
                });
        }
        for row in n..size {
            let scaled = self.matrix[row * size..][..n].iter().zip(&self.scale);
            let largest = scaled.fold(0.0, |largest, (x, scale)| {
                f64::max(largest, x.value().abs() * scale)
            });
            self.scale.push(inverse_root(largest * largest));
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

    /// How rows that depend on one another share their load: as equal springs below a rigid body do, whose forces are in proportion to
    /// what its motion presses them together, λ = A w. Then nᵀλ = 0 for every n with nᵀA = 0: one such equation for each row aside.
    fn share(&mut self) {
        let (n, rows) = (self.coordinates, self.size - self.coordinates);
        let weights = self
            .aside
            .iter()
            .map(|&aside| if aside { LAST } else { 1.0 });
        let weights: Vec<f64> = weights.collect();
        self.factor_rows((NEXT_TO_LAST, rows), &weights);
        let Self {
            lu, shares, scale, ..
        } = self;
        shares.clear();
        shares.resize(rows * rows, T::zero());
        for i in lu.dependent_rows().filter(|&i| i < rows) {
            shares[i * rows + i] = T::one();
        }
        lu.combine(|i, k, factor| {
            if i < rows {
                let ratio = scale[n + k] / scale[n + i];
                shares[i * rows + k] =
                    -factor * T::from_f64(ratio * ratio * weights[k] / weights[i]);
            }
        });
    }

    /// Chooses an independent subset of the rows of A, no more than `most`: elimination with complete pivoting. A row that differs from a
    /// combination of others by δ adds a pivot of δ² to the whole matrix.
    ///
    /// Of rows from which others were eliminated rounding or a tolerated error may be all that is left: the slip of a second point of a
    /// rod that lies flat turns it by nothing, and must not stand for the contact that does. So with a row of which there is next to nothing
    /// here: a side rod in its dead centre must not stand for the other one.
    fn choose_rows(&mut self, least: f64, most: usize) {
        let rows = self.size - self.coordinates;
        let weights: Vec<f64> = self
            .strengths()
            .map(|strength| strength.clamp(LITTLE, 1.0))
            .collect();
        self.factor_rows((least, most), &weights);
        self.aside.fill(false);
        for i in self.lu.dependent_rows() {
            if i < rows {
                self.aside[i] = true;
            }
        }
    }

    /// What there is of each row, beside the largest one and what other rows have taken from it.
    fn strengths(&self) -> impl Iterator<Item = f64> {
        let scale = &self.scale[self.coordinates..];
        let largest = scale.iter().fold(0.0, |size, x| f64::max(size, 1.0 / x));
        let sizes = scale.iter().zip(&self.taken);
        sizes.map(move |(scale, taken)| 1.0 / (scale * taken.max(largest)))
    }

    /// Whether there is next to nothing of a row that is kept beside one that is held aside: a long step may bring a side rod into its dead
    /// centre that was not there where the step began.
    fn keeps_weak_rows(&self) -> bool {
        let (mut kept, mut aside) = (f64::INFINITY, 0.0_f64);
        for (strength, out) in self.strengths().zip(&self.aside) {
            match out {
                true => aside = aside.max(strength),
                false => kept = kept.min(strength),
            }
        }
        kept < WEAK * aside
    }

    /// LU of the scaled rows of A with these weights, up to pivots of this size and so many.
    fn factor_rows(&mut self, limits: (f64, usize), weights: &[f64]) {
        let (n, size) = (self.coordinates, self.size);
        let rows = size - n;
        // Square with zeros, so that the same factorization serves.
        let wide = n.max(rows);
        let (matrix, scale) = (&self.matrix, &self.scale);
        self.lu.factor_to(limits, wide, |i, row| {
            if i < rows {
                let elements = matrix[(n + i) * size..][..n].iter().zip(scale);
                for (x, (&element, by)) in row.iter_mut().zip(elements) {
                    *x = element * T::from_f64(scale[n + i] * by * weights[i]);
                }
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

    /// Whether the rows set aside agree with the solution `x` of the right-hand side `b`. Those that are held need not, away from the
    /// constraints.
    ///
    /// What is to agree may be all rounding (the centripetal terms of a rod that lies still), so that it is compared with the
    /// acceleration that the forcing f could give the row, √(Σaⱼ²/mⱼ · Σfⱼ²/mⱼ), too, and with the terms of its bias, which may have
    /// cancelled: with the `biases` for velocities that are not those of the motion. What still disagrees may be rounding of accelerations
    /// that the rows kept hardly determine: that of the scalar part of a quaternion where it is 1.
    pub(crate) fn check_rows_aside(
        &mut self,
        x: &[T],
        b: &[T],
        biases: impl FnOnce() -> Vec<f64>,
    ) -> Result<(), SolveError> {
        if self.factors == Factors::Held || !self.has_rows_aside() {
            return Ok(());
        }
        let biases = biases();
        let (n, size) = (self.coordinates, self.size);
        let weighted = |j: usize, number: T| {
            let inertia = self.matrix[j * size + j].value();
            if inertia > 0.0 {
                number.value() * number.value() / inertia
            } else {
                0.0
            }
        };
        let drive: f64 = (0..n).map(|j| weighted(j, b[j])).sum();
        let mut misses = Vec::new();
        for (row, _) in self.aside.iter().enumerate().filter(|(_, aside)| **aside) {
            let (mut residual, mut largest) = (-b[n + row].value(), b[n + row].value().abs());
            for (j, x) in x[..n].iter().enumerate() {
                let term = self.matrix[(n + row) * size + j].value() * x.value();
                residual += term;
                largest = largest.max(term.abs());
            }
            // Of a system at rest nothing is left but squares of the rounding of its velocities.
            let largest = largest.max(SQUARE_OF_ROUNDING);
            let elements = &self.matrix[(n + row) * size..][..n];
            let compliance = elements.iter().enumerate().map(|(j, &a)| weighted(j, a));
            let driven = (drive * compliance.sum::<f64>()).sqrt();
            let miss = residual.abs()
                - consistent::<T>() * largest
                - BESIDE_ROUNDING * epsilon::<T>() * (driven + biases[row]);
            if miss > 0.0 {
                misses.push((row, miss, residual.abs() / largest));
            }
        }
        if misses.is_empty() {
            return Ok(());
        }
        let mut open = vec![0.0; n];
        self.open(x, &mut open);
        for (row, miss, residual) in misses {
            let elements = self.matrix[(n + row) * size..].iter().zip(&open);
            let terms = elements.map(|(a, open)| a.value().abs() * open);
            if miss > BESIDE_ROUNDING * epsilon::<T>() * terms.sum::<f64>() {
                return Err(SolveError::Inconsistent { row, residual });
            }
        }
        Ok(())
    }
}
