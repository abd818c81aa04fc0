//! The Kepler problem.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{agree, run};

/// The Kepler problem.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = -mu / sqrt(x^2 + y^2),
)]
struct Kepler {
    mu: f64,
}

#[test]
fn an_eccentric_orbit_returns() {
    let e: f64 = 0.9;
    let start = state(&[1.0 - e, 0.0], &[0.0, ((1.0 + e) / (1.0 - e)).sqrt()]);
    let trajectory = run(&Kepler { mu: 1.0 }, start.clone(), 10.0 * 2.0 * PI);
    agree("x", trajectory.final_state().q[0], start.q[0], 1e-9);
    agree("y", trajectory.final_state().q[1], 0.0, 1e-8);
}
