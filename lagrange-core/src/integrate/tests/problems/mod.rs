//! Second-order problems with known solutions, one a file, shared by all methods.

mod falling;
mod harmonic;
mod kepler;
mod pendulum;
mod prothero;

pub use falling::Falling;
pub use harmonic::Harmonic;
pub use kepler::Kepler;
pub use pendulum::Pendulum;
pub use prothero::Prothero;

use crate::arithmetic::products::Row;
use crate::integrate::{Acceleration, Tolerance, taylor};

/// A problem with a known solution.
pub trait Problem: Acceleration<f64, Error = &'static str> {
    /// Number of coordinates.
    const COORDINATES: usize;

    /// Positions and velocities at time `t`, where the solution is known.
    fn solution(&self, t: f64) -> (Vec<f64>, Vec<f64>);

    /// Coefficients of the accelerations in powers of the time from those of positions and velocities, order by order:
    /// the k-th may use q₀ … qₖ and v₀ … vₖ, which are given.
    fn acceleration_series(&self, t: f64, series: &mut Coefficients, k: usize) -> Vec<f64>;
}

/// Taylor coefficients about a state, and what a problem keeps beside them.
#[derive(Clone, Debug)]
pub struct Coefficients {
    /// Positions, one row per coordinate.
    pub q: Vec<Vec<f64>>,
    /// Velocities, one row per coordinate.
    pub v: Vec<Vec<f64>>,
    /// Auxiliary series of the problem.
    pub more: Vec<Vec<f64>>,
}

impl Coefficients {
    /// Step size for these series.
    pub fn step_size(&self, order: usize, tolerance: Tolerance) -> Option<f64> {
        let rows = |series: &[Vec<f64>]| -> Vec<Row<f64>> {
            let row =
                |c: &Vec<f64>| core::array::from_fn(|k| c.get(k).copied().unwrap_or_default());
            series.iter().map(row).collect()
        };
        taylor::step_size([&rows(&self.q), &rows(&self.v)], order, tolerance)
    }
}

/// The series of a problem's solution through a state, to `order`.
pub fn series<P: Problem>(problem: &P, t: f64, q: &[f64], v: &[f64], order: usize) -> Coefficients {
    let column = |x: &[f64]| x.iter().map(|&x| vec![x]).collect::<Vec<_>>();
    let mut series = Coefficients {
        q: column(q),
        v: column(v),
        more: vec![Vec::new(); 8],
    };
    for k in 0..order {
        let a = problem.acceleration_series(t, &mut series, k);
        for (i, a) in a.into_iter().enumerate() {
            let next = series.v[i][k] / (k + 1) as f64;
            series.q[i].push(next);
            series.v[i].push(a / (k + 1) as f64);
        }
    }
    series
}

/// Σⱼ aⱼ bₖ₋ⱼ
pub fn convolve(a: &[f64], b: &[f64], k: usize) -> f64 {
    (0..=k).map(|j| a[j] * b[k - j]).sum()
}
