//! The guards of a step as polynomials in s ∈ [0, 1].
//!
//! With Taylor series they come exactly, from the coefficients of the step. With a Runge–Kutta method the guards are
//! evaluated at the Chebyshev–Lobatto points of the dense output and interpolated.

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError};
use crate::integrate::StepPolynomial;
use crate::mode::Mode;
use crate::modes::guard::{self, Guard, Series};
use crate::modes::reading::Reading;
use crate::system::System;

/// The polynomials of all guards of a step.
#[derive(Clone, Debug, Default)]
pub(super) struct Curves {
    guards: Vec<Series>,
    stops: Vec<Series>,
    marks: Vec<Series>,
    first_stop: Vec<usize>,
    first_mark: Vec<usize>,
    watches: Vec<Guard>,
    /// Interpolation: samples → coefficients, row-major, for `nodes`.
    matrix: Vec<f64>,
    nodes: Vec<f64>,
}

impl Curves {
    /// Room for the stops and marks of a system.
    pub(super) fn new<S: System>() -> Self {
        let d = S::DESCRIPTION;
        let mut curves = Curves::default();
        for (i, stop) in d.stops.iter().enumerate() {
            curves.first_stop.push(curves.stops.len());
            for k in 0..stop.terms.len() {
                curves.stops.push(Series::ZERO);
                curves.watches.push(Guard::Stop(i, k));
            }
        }
        for (i, mark) in d.marks.iter().enumerate() {
            curves.first_mark.push(curves.marks.len());
            for k in 0..mark.terms.len() {
                curves.marks.push(Series::ZERO);
                curves.watches.push(Guard::Mark(i, k));
            }
        }
        curves
    }

    /// Guard `k` of the mode.
    pub(super) fn mode_guard(&self, k: usize) -> &[f64] {
        self.guards[k].as_slice()
    }

    /// Term `k` of stop `i`.
    pub(super) fn stop_term(&self, i: usize, k: usize) -> &[f64] {
        self.stops[self.first_stop[i] + k].as_slice()
    }

    /// Term `k` of mark `i`.
    pub(super) fn mark_term(&self, i: usize, k: usize) -> &[f64] {
        self.marks[self.first_mark[i] + k].as_slice()
    }

    /// Takes the guards from the series that `dynamics` holds, over a step of length `h`.
    pub(super) fn take_series<S: System>(
        &mut self,
        dynamics: &Dynamics<S>,
        mode: &Mode,
        guards: &[Guard],
        h: f64,
    ) {
        let reading = Reading::Series(dynamics);
        self.guards.clear();
        self.guards
            .extend(guards.iter().map(|&g| guard::series(g, mode, &reading, h)));
        let stops = self.stops.len();
        let curves = self.stops.iter_mut().chain(&mut self.marks);
        debug_assert!(stops <= self.watches.len());
        for (curve, &g) in curves.zip(&self.watches) {
            *curve = guard::series(g, mode, &reading, h);
        }
    }

    /// Leaves out what is above `degree`.
    pub(super) fn truncate(&mut self, degree: usize) {
        let all = self.guards.iter_mut().chain(&mut self.stops);
        all.chain(&mut self.marks).for_each(|curve| curve.truncate(degree));
    }

    /// How far the polynomials are off at part `s` of the step, in units of what is allowed; `dynamics` holds the values of
    /// the state there.
    ///
    /// The step is chosen for the coordinates, but a guard is a function of them whose series may converge no further than
    /// a part of it: in free flight the coordinates are polynomials, the distance √(x² + y²) is not.
    pub(super) fn defect<S: System>(
        &self,
        dynamics: &mut Dynamics<S>,
        mode: &Mode,
        guards: &[Guard],
        s: f64,
        tolerance: f64,
    ) -> f64 {
        if !self.watches.is_empty() {
            dynamics.report_value();
        }
        let reading = Reading::Values(dynamics);
        let all = guards.iter().chain(&self.watches);
        let curves = self.guards.iter().chain(&self.stops).chain(&self.marks);
        let mut worst = 0.0;
        for (curve, &g) in curves.zip(all) {
            let curve = curve.as_slice();
            let value = guard::series(g, mode, &reading, 1.0);
            let value = value.as_slice().first().copied().unwrap_or(0.0);
            let (mut found, mut size) = (0.0, 0.0);
            for c in curve.iter().rev() {
                found = found * s + c;
                size = size * s + c.abs();
            }
            // Forces are second derivatives, and the worse for it.
            let (share, floor) = match g {
                Guard::Normal(_)
                | Guard::StickUpper(_)
                | Guard::StickLower(_)
                | Guard::StickCone(_)
                | Guard::Bearing(_) => (1e4, 1e-10),
                _ => (10.0, 1e-13),
            };
            let allowed = (share * tolerance).max(floor) * (size + value.abs());
            let ratio = (found - value).abs() / (allowed + 64.0 * f64::EPSILON);
            worst = if ratio > worst || ratio.is_nan() {
                ratio
            } else {
                worst
            };
        }
        worst
    }

    /// Samples the guards along the dense output of a step and interpolates them.
    ///
    /// # Errors
    /// The equations of motion could not be evaluated somewhere in the step.
    pub(super) fn sample<S: System>(
        &mut self,
        dynamics: &mut Dynamics<S>,
        mode: &Mode,
        guards: &[Guard],
        step: &StepPolynomial<S::Scalar>,
        q: &mut [S::Scalar],
        v: &mut [S::Scalar],
    ) -> Result<(), EvaluationError> {
        self.prepare(step.degree + 1);
        let m = self.nodes.len();
        self.guards.clear();
        self.guards.resize(guards.len(), Series::ZERO);
        let stops_and_marks = self.stops.iter_mut().chain(&mut self.marks);
        stops_and_marks.for_each(|curve| *curve = Series::ZERO);
        for j in 0..m {
            let s = self.nodes[j];
            step.state_into(S::Scalar::from_f64(s), q, v);
            dynamics.value(step.t + step.h * S::Scalar::from_f64(s), q, v)?;
            // Stops and marks read the tape after the solve.
            dynamics.report_value();
            let reading = Reading::Values(dynamics);
            let column = |k: usize| self.matrix[k * m + j];
            let all = guards.iter().chain(&self.watches);
            let curves = self
                .guards
                .iter_mut()
                .chain(&mut self.stops)
                .chain(&mut self.marks);
            for (curve, &g) in curves.zip(all) {
                let sample = guard::series(g, mode, &reading, 1.0)
                    .as_slice()
                    .first()
                    .copied()
                    .unwrap_or(0.0);
                curve.accumulate(m, |k| column(k) * sample);
            }
        }
        Ok(())
    }

    /// Chebyshev–Lobatto points on [0, 1] and the inverse of their Vandermonde matrix.
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
