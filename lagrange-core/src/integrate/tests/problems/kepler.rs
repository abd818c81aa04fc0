//! Kepler's problem r̈ = −r/|r|³ from the pericentre: Kepler's equation E − e sin E = t gives the solution.

use super::{Coefficients, Problem, convolve};
use crate::integrate::Acceleration;

/// An orbit of semi-major axis 1, period 2π.
pub struct Kepler {
    pub eccentricity: f64,
}

impl Kepler {
    /// −1/2
    pub fn energy(q: &[f64], v: &[f64]) -> f64 {
        0.5 * (v[0] * v[0] + v[1] * v[1]) - 1.0 / q[0].hypot(q[1])
    }
}

impl Acceleration<f64> for Kepler {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        _: f64,
        q: &[f64],
        _: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        let square = q[0] * q[0] + q[1] * q[1];
        let cube = square * square.sqrt();
        dv[0] = -q[0] / cube;
        dv[1] = -q[1] / cube;
        Ok(())
    }
}

impl Problem for Kepler {
    const COORDINATES: usize = 2;

    fn solution(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let e = self.eccentricity;
        let mut anomaly = t;
        for _ in 0..60 {
            anomaly -= (anomaly - e * anomaly.sin() - t) / (1.0 - e * anomaly.cos());
        }
        let (sin, cos) = anomaly.sin_cos();
        let minor = (1.0 - e * e).sqrt();
        let rate = 1.0 / (1.0 - e * cos);
        (
            vec![cos - e, minor * sin],
            vec![-sin * rate, minor * cos * rate],
        )
    }

    /// u = x² + y², w = u^(−3/2): u₀ k wₖ = Σⱼ (−3/2 (k − j) − j) uₖ₋ⱼ wⱼ.
    fn acceleration_series(&self, _: f64, series: &mut Coefficients, k: usize) -> Vec<f64> {
        let square =
            convolve(&series.q[0], &series.q[0], k) + convolve(&series.q[1], &series.q[1], k);
        series.more[0].push(square);
        let u = &series.more[0];
        let next = if k == 0 {
            u[0].powf(-1.5)
        } else {
            let w = &series.more[1];
            let sum: f64 = (0..k)
                .map(|j| (-1.5 * (k - j) as f64 - j as f64) * u[k - j] * w[j])
                .sum();
            sum / (u[0] * k as f64)
        };
        series.more[1].push(next);
        (0..2)
            .map(|i| -convolve(&series.q[i], &series.more[1], k))
            .collect()
    }
}
