//! A step of a finished run: its polynomials, and what is declared at instants of it.

use crate::declaration::AtState;
use crate::integrate::StepPolynomial;

/// The polynomials of a step.
#[derive(Debug)]
pub(super) struct Step {
    pub motion: StepPolynomial<f64>,
    /// The part of it that belongs to the motion.
    pub end: f64,
}

impl Step {
    /// Takes positions and velocities at part `s` of it.
    pub fn state(&self, s: f64, q: &mut [f64], v: &mut [f64]) {
        for i in 0..q.len() {
            (q[i], v[i]) = (self.motion.position(i, s), self.motion.velocity(i, s));
        }
    }

    /// Evaluates values at part `s` of it.
    pub fn at(&self, s: f64, values: &mut AtState) {
        self.state(s, &mut values.q, &mut values.v);
        for (i, acceleration) in values.acceleration.iter_mut().enumerate() {
            *acceleration = self.motion.acceleration(i, s);
        }
        values.evaluate(self.motion.time(s));
    }
}
