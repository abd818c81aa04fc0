//! A body thrown in a uniform field: a parabola, whose Taylor series ends.

use super::{Coefficients, Problem};
use crate::integrate::Acceleration;

/// Free fall in the plane, thrown with velocity (3, 4) from (1, 2), g = 9.81.
pub struct Falling;

const GRAVITY: f64 = 9.81;

impl Acceleration<f64> for Falling {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        _: f64,
        _: &[f64],
        _: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        dv.copy_from_slice(&[0.0, -GRAVITY]);
        Ok(())
    }
}

impl Problem for Falling {
    const COORDINATES: usize = 2;

    fn solution(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        (
            vec![1.0 + 3.0 * t, 2.0 + 4.0 * t - 0.5 * GRAVITY * t * t],
            vec![3.0, 4.0 - GRAVITY * t],
        )
    }

    fn acceleration_series(&self, _: f64, _: &mut Coefficients, k: usize) -> Vec<f64> {
        vec![0.0, if k == 0 { -GRAVITY } else { 0.0 }]
    }
}
