//! The pendulum θ̈ = −sin θ from rest at θ₀. Its period is 2π/agm(1, cos(θ₀/2)); what is known in between comes from
//! symmetry and from the energy: at a quarter of the period θ = 0 and θ̇ = −2 sin(θ₀/2).

use super::{Coefficients, Problem, convolve};
use crate::integrate::Acceleration;

/// Pendulum of unit frequency for small angles, from rest at `start`.
pub struct Pendulum {
    pub start: f64,
}

impl Pendulum {
    /// Time of a full swing, by the arithmetic–geometric mean.
    pub fn period(&self) -> f64 {
        let (mut a, mut g) = (1.0, (0.5 * self.start).cos());
        for _ in 0..10 {
            (a, g) = (0.5 * (a + g), (a * g).sqrt());
        }
        core::f64::consts::TAU / a
    }

    /// θ̇²/2 − cos θ
    pub fn energy(q: &[f64], v: &[f64]) -> f64 {
        0.5 * v[0] * v[0] - q[0].cos()
    }
}

impl Acceleration<f64> for Pendulum {
    type Error = &'static str;

    fn acceleration(
        &mut self,
        _: f64,
        q: &[f64],
        _: &[f64],
        dv: &mut [f64],
    ) -> Result<(), Self::Error> {
        dv[0] = -q[0].sin();
        Ok(())
    }
}

impl Problem for Pendulum {
    const COORDINATES: usize = 1;

    /// SwitchFacts at multiples of a quarter of the period only.
    fn solution(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let quarters = 4.0 * t / self.period();
        assert!(
            (quarters - quarters.round()).abs() < 1e-12,
            "not known at {t}"
        );
        let fastest = 2.0 * (0.5 * self.start).sin();
        let (q, v) = [
            (self.start, 0.0),
            (0.0, -fastest),
            (-self.start, 0.0),
            (0.0, fastest),
        ][quarters.round() as usize % 4];
        (vec![q], vec![v])
    }

    /// s = sin θ, c = cos θ: ṡ = c θ̇, ċ = −s θ̇.
    fn acceleration_series(&self, _: f64, series: &mut Coefficients, k: usize) -> Vec<f64> {
        let (sin, cos) = if k == 0 {
            series.q[0][0].sin_cos()
        } else {
            let (s, c, v) = (&series.more[0], &series.more[1], &series.v[0]);
            (
                convolve(c, v, k - 1) / k as f64,
                -convolve(s, v, k - 1) / k as f64,
            )
        };
        series.more[0].push(sin);
        series.more[1].push(cos);
        vec![-sin]
    }
}
