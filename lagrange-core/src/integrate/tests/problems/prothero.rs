//! A stiff spring with a strong damper follows the slow motion cos t of its other end: q = cos t from the start, after
//! Prothero & Robinson (1974).

use super::{Coefficients, Problem};
use crate::integrate::Acceleration;

/// q̈ = −k (q − cos t) − c (q̇ + sin t) − cos t, critically damped: c = 2 √k.
pub struct Prothero {
    pub stiffness: f64,
}

impl Acceleration<f64> for Prothero {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        let (sin, cos) = t.sin_cos();
        let damping = 2.0 * self.stiffness.sqrt();
        dv[0] = -self.stiffness * (q[0] - cos) - damping * (v[0] + sin) - cos;
        Ok(())
    }
}

impl Problem for Prothero {
    const COORDINATES: usize = 1;

    fn solution(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let (sin, cos) = t.sin_cos();
        (vec![cos], vec![-sin])
    }

    fn acceleration_series(&self, _: f64, _: &mut Coefficients, _: usize) -> Vec<f64> {
        unreachable!("not a problem for the Taylor method")
    }
}
