//! A pendulum in Cartesian coordinates over very many periods: what remains of its constraint and its energy.
//!
//! ```console
//! $ cargo bench -p lagrange-problems --bench long_run                  # 10⁶ periods at tolerance 1e-16
//! $ cargo bench -p lagrange-problems --bench long_run -- 10000 1e-12
//! ```
//!
//! Rounding errors that are independent of each other add up to √steps times one of them; errors with a direction add up
//! to steps times one. The last column is the energy error in units of 2⁻⁵³ √steps.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::CartesianPendulum;
use std::time::Instant;

/// Swing from rest, rad from the downward vertical.
const START: f64 = 1.0;
/// Periods per run: what a run records is dropped after it.
const BLOCK: usize = 500;

fn main() {
    let numbers: Vec<f64> = std::env::args()
        .skip(1)
        .filter_map(|a| a.parse().ok())
        .collect();
    let periods = numbers.first().map_or(1_000_000, |&n| n as usize);
    let tolerance = numbers.get(1).copied().unwrap_or(1e-16);

    let scene = CartesianPendulum::default();
    let (g, l) = (scene.gravity, scene.length);
    let period = std::f64::consts::TAU * (l / g).sqrt() / agm(1.0, (0.5 * START).cos());
    let mut state = State::new(vec![l * START.sin(), -l * START.cos()], vec![0.0; 2]);
    let energy = |state: &State<f64>| {
        let [vx, vy] = [state.v[0], state.v[1]];
        0.5 * (vx * vx + vy * vy) / (g * l) + (state.q[1] / l + START.cos())
    };
    let simulation = Simulation::new(&scene).tolerance(tolerance);
    let begin = Instant::now();
    let (mut done, mut steps, mut projections) = (0, 0, 0);
    let mut residual: f64 = 0.0;
    let mut next = 100;
    println!(
        "  periods       steps  projections   s      |x²+y²-l²|   energy error / mgl   in 2⁻⁵³ √steps"
    );
    while done < periods {
        let block = BLOCK.min(periods - done).min(next - done);
        let trajectory = simulation
            .run(state, 0.0..block as f64 * period)
            .unwrap_or_else(|failure| panic!("{failure}"));
        state = trajectory.final_state().clone();
        done += block;
        steps += trajectory.work().steps;
        projections += trajectory.work().projections;
        let [x, y] = [state.q[0], state.q[1]];
        residual = residual.max((x * x + y * y - l * l).abs());
        if done == next || done == periods {
            let error = energy(&state);
            println!(
                "{done:9} {steps:11} {projections:11} {:6.2} {residual:14.1e} {error:18.2e} {:16.2}",
                begin.elapsed().as_secs_f64(),
                error / (0.5 * f64::EPSILON * (steps as f64).sqrt())
            );
            next = (next * 10).min(if done < 10 * BLOCK {
                usize::MAX
            } else {
                next + periods / 10
            });
        }
    }
}

/// Arithmetic-geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 1e-15 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}
