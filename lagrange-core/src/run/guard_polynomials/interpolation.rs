//! The guards of a step that are known by samples: evaluated at the Chebyshev–Lobatto points of the dense output and interpolated.
//! `run/samples` sees to it that the interpolation holds.

use super::GuardPolynomials;
use super::errors::{allowance, size};
use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError};
use crate::events::{clearance, deflate};
use crate::integrate::taylor::worse;
use crate::integrate::{StepPolynomial, polynomial_value as at};
use crate::mode::Mode;
use crate::modes::guard::{Guard, Sums};

/// Samples of a guard in a step of a Runge–Kutta method, at least.
const FEWEST_SAMPLES: usize = 8;

/// Coefficients of an interpolation lose so many digits to rounding, relative.
const INTERPOLATION: f64 = 1e-11;

/// An interpolated guard may be off by this share of what would give it other roots.
const AWAY: f64 = 1e-2;

/// The same share where it is known to what an end of a step may be off.
const CLOSE: f64 = 0.3;

/// Polynomials on [0, 1] from their values at nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Interpolation {
    /// Chebyshev–Lobatto points.
    nodes: Vec<f64>,
    /// Coefficients per sample, row-major: the inverse of the Vandermonde matrix of the nodes.
    matrix: Vec<f64>,
}

impl Interpolation {
    /// Gets ready for `m` nodes.
    fn prepare(&mut self, m: usize) {
        if self.nodes.len() == m {
            return;
        }
        let last = (m - 1) as f64;
        self.nodes = (0..m)
            .map(|j| 0.5 - 0.5 * (core::f64::consts::PI * j as f64 / last).cos())
            .collect();
        self.nodes[0] = 0.0;
        self.nodes[m - 1] = 1.0;
        self.matrix = vec![0.0; m * m];
        for j in 0..m {
            // Coefficients of the Lagrange polynomial of node j.
            let mut c = vec![0.0; m];
            c[0] = 1.0;
            for (degree, i) in (0..m).filter(|i| *i != j).enumerate() {
                let scale = 1.0 / (self.nodes[j] - self.nodes[i]);
                for k in (0..=degree).rev() {
                    c[k + 1] += c[k] * scale;
                    c[k] *= -self.nodes[i] * scale;
                }
            }
            for (k, c) in c.into_iter().enumerate() {
                self.matrix[k * m + j] = c;
            }
        }
    }
}

/// How well the zero of a guard is located.
#[derive(Clone, Copy, Debug)]
pub(in crate::run) enum Located {
    /// To what its interpolation may be off at this tolerance.
    ByInterpolation(f64),
    /// To rounding.
    Exactly,
}

impl GuardPolynomials {
    /// Samples the guards along the dense output of a step and interpolates them.
    ///
    /// # Errors
    /// The equations of motion could not be evaluated somewhere in the step.
    pub(in crate::run) fn sample<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        step: &StepPolynomial<T>,
        q: &mut [T],
        v: &mut [T],
    ) -> Result<(), EvaluationError> {
        // A guard bends more than the coordinates that it is made of.
        let m = (step.degree + 1).max(FEWEST_SAMPLES);
        self.interpolation.prepare(m);
        self.shape(m);
        for curve in &mut self.list {
            (curve.sums, curve.stays) = (Sums::UNKNOWN, false);
        }
        self.coefficients.fill(0.0);
        if self.coefficients.is_empty() {
            return Ok(());
        }
        for j in 0..m {
            let s = self.interpolation.nodes[j];
            step.state_into(T::from_f64(s), q, v);
            let time = step.t + step.h * T::from_f64(s);
            let forces = dynamics.value(time, q, v);
            if forces.is_err() {
                dynamics.tape_without_forces(time, q, v);
            }
            if j == 0 {
                dynamics.take_directions();
            }
            // Stops and marks read the tape after the solve.
            dynamics.report_value();
            for index in 0..self.list.len() {
                let sample = self.value(index, mode, dynamics);
                if let Err(error) = forces
                    && (self.list[index].guard.is_force() || sample.is_nan())
                {
                    return Err(error);
                }
                if j + 1 == m {
                    // The coefficients round more than that.
                    self.list[index].sums.end = sample;
                }
                let curve = &mut self.coefficients[index * m..][..m];
                if j == 0 {
                    curve[0] = sample;
                    continue;
                }
                // What does not change has no part in the rounding of the coefficients, which are large.
                let change = sample - curve[0];
                for (c, row) in curve[1..]
                    .iter_mut()
                    .zip(self.interpolation.matrix.chunks_exact(m).skip(1))
                {
                    *c += row[j] * change;
                }
            }
        }
        Ok(())
    }

    /// How far interpolated guards are off at part `s` of the step, in units of what is allowed; `dynamics` holds the values of
    /// the state there. A guard need not be known well as long as it has no other roots than its interpolation.
    pub(in crate::run) fn interpolation_defect<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        tolerance: f64,
    ) -> f64 {
        dynamics.report_value();
        let mut worst = 0.0;
        for (index, curve) in self.list.iter().enumerate() {
            let c = self.curve(index);
            let value = self.value(index, mode, dynamics);
            let size = size(value, c);
            let error = (at(c, s) - value).abs();
            let rounding = self.rounding(error, curve.guard, dynamics);
            let allowed = |located: bool| {
                let share = allowance::<T>(curve.guard, tolerance, located);
                share.max(INTERPOLATION) * size + rounding
            };
            let [missed, located] = [false, true].map(allowed);
            // Where it begins with zero the root is known.
            let begins = usize::from(c[0].abs() <= located);
            let clear = clearance(deflate(c, begins)) * s.powi(begins as i32);
            let accepted = located.max(AWAY * clear).max(missed.min(CLOSE * clear));
            worst = worse(worst, error / accepted);
        }
        worst
    }

    /// Whether guard number `index` is zero at the last value of `dynamics`, to what it is located to. Those of undetermined forces are
    /// corrected by themselves.
    pub(in crate::run) fn vanishes<T: Scalar>(
        &self,
        index: usize,
        mode: &Mode,
        dynamics: &Dynamics<T>,
        located: Located,
    ) -> bool {
        let zero = self.zero(index, mode, dynamics, located);
        matches!(self.list[index].guard, Guard::Composite(_))
            || self.value(index, mode, dynamics).abs() <= zero
    }

    /// Up to which size guard number `index` counts as zero there.
    pub(in crate::run) fn zero<T: Scalar>(
        &self,
        index: usize,
        mode: &Mode,
        dynamics: &Dynamics<T>,
        located: Located,
    ) -> f64 {
        let guard = self.list[index].guard;
        let share = match located {
            Located::ByInterpolation(tolerance) if !guard.is_force() => {
                allowance::<T>(guard, tolerance, true).max(INTERPOLATION)
            }
            // A force may come close to its limit and turn back.
            _ => allowance::<T>(guard, 0.0, true),
        };
        let (c, value) = (self.curve(index), self.value(index, mode, dynamics));
        share * size(value, c) + self.rounding(value.abs(), guard, dynamics)
    }

    /// Two parts of a step between the samples of its guards; nothing where none is sampled.
    pub(in crate::run) fn between_samples(&self) -> Option<[f64; 2]> {
        self.get(0)?;
        let nodes = &self.interpolation.nodes;
        let m = nodes.len();
        Some([m / 4, 2 * m / 3].map(|j| 0.5 * (nodes[j] + nodes[j + 1])))
    }
}
