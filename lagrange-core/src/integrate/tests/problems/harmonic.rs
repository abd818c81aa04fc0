//! q̈ = −ω² q, q(0) = 1 at rest: q = cos ωt.

use super::{Coefficients, Problem};
use crate::integrate::Acceleration;

/// Harmonic oscillator of angular frequency `omega`.
pub struct Harmonic {
    pub omega: f64,
}

impl Acceleration<f64> for Harmonic {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        _: f64,
        q: &[f64],
        _: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        dv[0] = -self.omega * self.omega * q[0];
        Ok(())
    }
}

impl Problem for Harmonic {
    const COORDINATES: usize = 1;

    fn solution(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let (sin, cos) = (self.omega * t).sin_cos();
        (vec![cos], vec![-self.omega * sin])
    }

    fn acceleration_series(&self, _: f64, series: &mut Coefficients, k: usize) -> Vec<f64> {
        vec![-self.omega * self.omega * series.q[0][k]]
    }
}
