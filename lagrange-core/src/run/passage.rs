//! Steps over a position where constraints lose rank, by collocation.
//!
//! The motion is smooth there, and so are its accelerations, which only cannot be had at the position itself, and are lost in rounding near it. A
//! polynomial that has them on both sides is as good as those of other steps, where a Taylor series from one side carries rounding over
//! that is amplified by a power of the way: q̈(sⱼ) = a(sⱼ) at points sⱼ of the step, by iteration from a polynomial that is near. States at
//! the points are moved onto the constraints before their accelerations are taken, so that errors across a branch do not grow. There are more points
//! than coefficients, and those count less that are nearer to the middle, where the position is to be. Collocation: Hairer, Nørsett & Wanner (1993),
//! section II.7; least squares: Björck (1996), Numerical Methods for Least Squares Problems, section 8.3.

use super::Run;
use crate::arithmetic::Scalar;
use crate::integrate::taylor::worse;
use core::f64::consts::PI;
use nalgebra::DMatrix;

/// Points of a step at which accelerations are taken; an even number, for none is to be in the middle.
const POINTS: usize = 32;
/// Coefficients of the polynomials of accelerations.
pub(super) const COEFFICIENTS: usize = 18;
/// So many times the accelerations are taken.
const MOST_ITERATIONS: usize = 20;
/// Changes of the velocities below this, in units of what a step may get wrong, are enough.
const ENOUGH: f64 = 1e-3;
/// Changes shrink by this factor at least while it is of use to go on.
const CONVERGES: f64 = 0.7;
/// So many times more where numbers have derivatives.
const FOLLOWING: usize = 4;

/// Memory of such steps.
#[derive(Clone, Debug, Default)]
pub(super) struct Passage<T> {
    /// Chebyshev points of a step from 0 to 1.
    points: Vec<f64>,
    /// Coefficients of a polynomial by its values at the points, a row of these per power.
    fit: Vec<f64>,
    /// What accelerations the polynomial lacks, a row of points per coordinate.
    lacking: Vec<T>,
}

impl<T: Scalar> Passage<T> {
    /// Memory for so many coordinates.
    pub(super) fn new(coordinates: usize) -> Self {
        let angle = |j: usize| PI * (j as f64 + 0.5) / POINTS as f64;
        let points: Vec<f64> = (0..POINTS).map(|j| 0.5 - 0.5 * angle(j).cos()).collect();
        let weight = |j: usize| weight(points[j]);
        // The Chebyshev polynomial of degree k there is cos k(π − angle).
        let values = DMatrix::from_fn(POINTS, COEFFICIENTS, |j, k| {
            weight(j) * (k as f64 * (PI - angle(j))).cos()
        });
        let fit = values
            .pseudo_inverse(0.0)
            .map(|inverse| in_powers() * inverse);
        let fit = fit.unwrap_or_default();
        let rows = fit.row_iter();
        let fit = rows.flat_map(|row| {
            row.iter()
                .enumerate()
                .map(|(j, c)| c * weight(j))
                .collect::<Vec<_>>()
        });
        Self {
            fit: fit.collect(),
            points,
            lacking: vec![T::zero(); coordinates * POINTS],
        }
    }
}

impl<T: Scalar> Run<T> {
    /// Gives the polynomial of the step at hand, which is near the motion, its accelerations. What rounding leaves of them lacking, in units of what a step may
    /// get wrong; nothing if they cannot be had.
    pub(super) fn collocate(&mut self) -> Option<f64> {
        self.close_positions();
        let mut before = f64::INFINITY;
        let mut left: f64 = 0.0;
        // Derivatives follow the numbers.
        let mut more = T::DERIVATIVES.min(1) * FOLLOWING;
        for _ in 0..MOST_ITERATIONS {
            let lacks = self.take_lacking()?;
            self.add_lacking();
            if lacks <= ENOUGH || !(lacks < CONVERGES * before) {
                left = left.max(lacks);
                if more == 0 {
                    break;
                }
                more -= 1;
            }
            before = lacks;
        }
        Some(left)
    }

    /// Makes the polynomials of positions those whose derivatives are the polynomials of velocities: a series ends with the same power in both.
    fn close_positions(&mut self) {
        let step = &mut self.stepper.step;
        let (last, h) = (step.degree, step.h);
        step.raise(last.max(COEFFICIENTS) + 1);
        for i in 0..step.coordinates() {
            let (q, v) = step.rows_mut(i);
            q[last + 1] = h * v[last] / T::from_f64((last + 1) as f64);
        }
    }

    /// Takes what accelerations the polynomial lacks at its points; the largest change of a velocity that follows from them, in units of what a step may get
    /// wrong.
    fn take_lacking(&mut self) -> Option<f64> {
        let h = self.stepper.step.h.value();
        let mut worst = 0.0;
        for j in 0..POINTS {
            let place = self.passage.points[j];
            self.evaluate_onto_constraints(place).ok()?;
            let (step, v) = (&self.stepper.step, &self.stepper.scratch.v);
            let tolerance = self.settings.per_step();
            for (i, &a) in self.dynamics.acceleration().iter().enumerate() {
                let lacks = a - step.acceleration(i, T::from_f64(place));
                let change = (h * lacks.value()).abs();
                let allowed = tolerance.scale(i, v[i].value().abs());
                worst = worse(worst, weight(place) * change / allowed);
                self.passage.lacking[i * POINTS + j] = lacks;
            }
        }
        worst.is_finite().then_some(worst)
    }

    /// Adds them, and what follows for velocities and positions.
    fn add_lacking(&mut self) {
        let (step, passage) = (&mut self.stepper.step, &self.passage);
        let h = step.h;
        for (i, lacking) in passage.lacking.chunks_exact(POINTS).enumerate() {
            let (q, v) = step.rows_mut(i);
            for (k, row) in passage.fit.chunks_exact(POINTS).enumerate() {
                let terms = row.iter().zip(lacking);
                let sum = terms.fold(T::zero(), |sum, (&c, &a)| sum + T::from_f64(c) * a);
                let change = sum * h / T::from_f64((k + 1) as f64);
                v[k + 1] += change;
                q[k + 2] += change * h / T::from_f64((k + 2) as f64);
            }
        }
    }
}

/// How much the acceleration at part `s` of the step counts: rounding is amplified by the inverse of the square of the distance.
fn weight(s: f64) -> f64 {
    (2.0 * s - 1.0).powi(2)
}

/// The coefficients, in powers of s, of the Chebyshev polynomials of 2 s − 1, a column each.
fn in_powers() -> DMatrix<f64> {
    let mut columns = DMatrix::zeros(COEFFICIENTS, COEFFICIENTS);
    columns[(0, 0)] = 1.0;
    (columns[(0, 1)], columns[(1, 1)]) = (-1.0, 2.0);
    for k in 2..COEFFICIENTS {
        // Tₖ = 2 (2 s − 1) Tₖ₋₁ − Tₖ₋₂
        for power in 0..=k {
            let shifted = match power {
                0 => 0.0,
                power => 4.0 * columns[(power - 1, k - 1)],
            };
            columns[(power, k)] = shifted - 2.0 * columns[(power, k - 1)] - columns[(power, k - 2)];
        }
    }
    columns
}
