//! The Kepler problem.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{agree, run, run_by};

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

#[test]
fn an_orbit_keeps_energy_momentum_and_its_axis() {
    let scene = Kepler { mu: 1.0 };
    let start = state(&[1.0, 0.0], &[0.1, 1.2]);
    let constants = |q: &[f64], v: &[f64]| {
        let r = q[0].hypot(q[1]);
        let momentum = q[0] * v[1] - q[1] * v[0];
        [
            0.5 * (v[0] * v[0] + v[1] * v[1]) - 1.0 / r,
            momentum,
            // Laplace–Runge–Lenz
            v[1] * momentum - q[0] / r,
            -v[0] * momentum - q[1] / r,
        ]
    };
    let trajectory = run(&scene, start.clone(), 100.0);
    let expected = constants(&start.q, &start.v);
    for k in 0..=100 {
        let now = trajectory.sampler().at(f64::from(k)).expect("inside");
        let found = constants(&now.state.q, &now.state.v);
        for (found, expected) in found.iter().zip(expected) {
            agree("constant", *found, expected, 1e-10);
        }
    }
}

/// In pericentre, after some time, the last digit of the time is as much as a step of what moves fastest.
#[test]
fn a_nearly_straight_orbit_returns_by_explicit_methods() {
    let e: f64 = 0.9999;
    let start = state(&[1.0 + e, 0.0], &[0.0, ((1.0 - e) / (1.0 + e)).sqrt()]);
    for method in ["dop853", "verner98"] {
        let run = run_by(
            &Kepler { mu: 1.0 },
            (method, 1e-12),
            start.clone(),
            6.0 * PI,
        );
        let State { q, v, .. } = run.final_state();
        let energy = 0.5 * (v[0] * v[0] + v[1] * v[1]) - 1.0 / q[0].hypot(q[1]);
        agree(method, energy, -0.5, 1e-8);
        agree(method, q[0], start.q[0], 1e-6);
        agree(method, q[1], 0.0, 1e-6);
    }
}
