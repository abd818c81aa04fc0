//! Rows that depend on others: an independent subset is chosen, those set aside share the load or carry none, and have to agree with the solution.

use super::{Factors, SolveError, Solver};
use crate::arithmetic::{Scalar, epsilon};
use crate::linear::lu::negligible;

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

/// Rows that have been set aside are scaled by this when the others are factored (2⁻⁴⁰): their pivots are below [`NEXT_TO_LAST`], and so none of
/// them counts as independent.
const LAST: f64 = NEXT_TO_LAST / 1024.0;

/// Independent rows have pivots larger than this (2⁻³⁰).
const NEXT_TO_LAST: f64 = 1.0 / 1073741824.0;

/// More than this times what rounding leaves of a number is no rounding.
const BESIDE_ROUNDING: f64 = 1e4;

impl<T: Scalar> Solver<T> {
    /// Factors the equilibrated matrix with the rows of an independent subset.
    pub(super) fn factor_independent(&mut self, most: usize) -> Result<(), SolveError> {
        self.choose_rows(negligible::<T>().sqrt(), most);
        self.factor_kept();
        match self.lu.undetermined() {
            Some(unknown) => Err(SolveError::Undetermined { unknown }),
            None => Ok(()),
        }
    }

    /// How rows that depend on one another share their load: as equal springs below a rigid body do, whose forces are in proportion to
    /// what its motion presses them together, λ = A w. Then nᵀλ = 0 for every n with nᵀA = 0: one such equation for each row aside.
    pub(super) fn share(&mut self) {
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
    pub(super) fn choose_rows(&mut self, least: f64, most: usize) {
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
    pub(super) fn keeps_weak_rows(&self) -> bool {
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
