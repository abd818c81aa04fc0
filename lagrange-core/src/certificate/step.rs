//! A step of a finished run: its polynomials, and what is declared at instants of it.

use crate::arithmetic::Pack;
use crate::declaration::AtState;
use crate::integrate::{AtPlaces, derivative_at, horner, horner_at, polynomial_derivative};

/// The polynomials of a step.
#[derive(Debug, Default)]
pub(super) struct Step {
    pub time: f64,
    pub length: f64,
    /// The part of it that belongs to the motion.
    pub end: f64,
    /// Number of coefficients of each.
    pub width: usize,
    /// Coefficients of all positions, then of all velocities.
    pub coefficients: Vec<f64>,
}

impl Step {
    pub fn polynomials(&self, which: usize) -> impl Iterator<Item = &[f64]> {
        let all = self.coefficients.chunks_exact(self.width);
        let n = all.len() / 2;
        all.skip(which * n).take(n)
    }

    /// Takes positions and velocities at part `s` of it.
    pub fn state(&self, s: f64, q: &mut [f64], v: &mut [f64]) {
        for (which, list) in [q, v].into_iter().enumerate() {
            for (x, c) in list.iter_mut().zip(self.polynomials(which)) {
                *x = horner(c, s);
            }
        }
    }

    /// Evaluates values at part `s` of it.
    pub fn at(&self, s: f64, values: &mut AtState) {
        self.state(s, &mut values.q, &mut values.v);
        for (acceleration, c) in values.acceleration.iter_mut().zip(self.polynomials(1)) {
            *acceleration = polynomial_derivative(c, s) / self.length;
        }
        values.evaluate(self.time + self.length * s);
    }

    /// Evaluates values at several parts of it.
    pub fn at_places(&self, places: AtPlaces, values: &mut AtState<AtPlaces>) {
        let positions = values.q.iter_mut().zip(self.polynomials(0));
        positions.for_each(|(q, c)| *q = horner_at(c, places));
        for (i, c) in self.polynomials(1).enumerate() {
            values.v[i] = horner_at(c, places);
            let slope = derivative_at(c, places);
            values.acceleration[i] = Pack(slope.0.map(|slope| slope / self.length));
        }
        let times = places.0.map(|s| self.time + self.length * s);
        values.evaluate(Pack(times));
    }
}
