//! The pendulum in Cartesian coordinates: a constraint of position level against Jacobi's elliptic functions.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{agm, agree, closure, run, run_by};

/// A pendulum in Cartesian coordinates.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x^2 + y^2 == length^2),
    start(level: x = length),
)]
struct CartesianPendulum {
    mass: f64,
    gravity: f64,
    length: f64,
}

#[test]
fn a_cartesian_pendulum_keeps_its_length_and_meets_jacobi() {
    let scene = CartesianPendulum {
        mass: 0.7,
        gravity: 9.81,
        length: 1.0,
    };
    let trajectory = run(&scene, scene.at(CartesianPendulum::LEVEL), 100.0);
    let end = trajectory.final_state();
    // Jacobi elliptic functions with 32 digits (mpmath); the index-reduced equations amplify errors about a thousand times.
    agree("x", end.q[0], 0.181_513_351_427_031_38, 1e-9);
    agree("y", end.q[1], -0.983_388_480_334_057_5, 1e-9);
    let mut sampler = trajectory.sampler();
    for k in 0..=200 {
        let now = sampler.at(0.5 * f64::from(k)).expect("inside");
        assert!((now.state.q[0].hypot(now.state.q[1]) - 1.0).abs() < 1e-12);
        assert!((now.state.q[0] * now.state.v[0] + now.state.q[1] * now.state.v[1]).abs() < 1e-11);
        // Tension −2λl = m(v²/l − g y/l).
        let speed = now.state.v[0].powi(2) + now.state.v[1].powi(2);
        agree(
            "λ",
            -2.0 * now.forces[0],
            0.7 * (speed - 9.81 * now.state.q[1]),
            1e-9,
        );
    }
    assert!(closure(&trajectory) < 1e-12);
}

/// The same pendulum by its angle from the bottom.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
)]
struct AnglePendulum {
    mass: f64,
    gravity: f64,
    length: f64,
}

#[test]
fn both_pendulums_swing_alike() {
    let (mass, gravity, length) = (0.7, 9.81, 1.3);
    let angle = AnglePendulum {
        mass,
        gravity,
        length,
    };
    let cartesian = CartesianPendulum {
        mass,
        gravity,
        length,
    };
    for (theta, omega) in [(0.3_f64, 0.0), (0.5 * PI, 0.0), (2.9, 0.0), (0.0, 8.0)] {
        let (s, c) = theta.sin_cos();
        let place = [length * s, -length * c];
        let speed = [length * omega * c, length * omega * s];
        let one = run(&angle, state(&[theta], &[omega]), 10.0);
        let two = run(&cartesian, state(&place, &speed), 10.0);
        for k in 0..=50 {
            let t = 0.2 * f64::from(k);
            let (a, b) = (one.sampler().at(t), two.sampler().at(t));
            let (a, b) = (a.expect("inside"), b.expect("inside"));
            agree("x", b.state.q[0], length * a.state.q[0].sin(), 1e-9);
            agree("y", b.state.q[1], -length * a.state.q[0].cos(), 1e-9);
            // The pull of the rod, −2 λ l along it.
            let pull = mass * (gravity * a.state.q[0].cos() + length * a.state.v[0] * a.state.v[0]);
            agree("pull", -2.0 * length * b.forces[0], pull, 1e-8);
        }
        assert!(closure(&one) < 1e-11);
    }
}

/// T = 2π √(l/g) / agm(1, cos ½θ₀) (Gauss), also from exactly π/2, where every second Taylor coefficient vanishes.
#[test]
fn the_period_is_that_of_gauss() {
    let scene = AnglePendulum {
        mass: 2.0,
        gravity: 9.81,
        length: 0.8,
    };
    for amplitude in [1e-3, 0.5, 0.5 * PI, 2.0, 3.0] {
        let period = 2.0 * PI * (0.8_f64 / 9.81).sqrt() / agm(1.0, (0.5_f64 * amplitude).cos());
        for method in ["taylor", "dop853", "verner98"] {
            let start = state(&[amplitude], &[0.0]);
            let run = run_by(&scene, (method, 1e-13), start, 5.0 * period);
            let end = run.final_state();
            agree(format!("{method}: θ"), end.q[0], amplitude, 1e-10);
            agree(format!("{method}: θ̇"), end.v[0], 0.0, 1e-9);
        }
    }
}

/// Two rods where one would do.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x^2 + y^2 == length^2),
    constraint(spare: 2 * (x^2 + y^2) == 2 * other^2),
)]
struct TwoRods {
    mass: f64,
    gravity: f64,
    length: f64,
    other: f64,
}

#[test]
fn a_redundant_rod_changes_nothing() {
    let two = TwoRods {
        mass: 0.7,
        gravity: 9.81,
        length: 1.0,
        other: 1.0,
    };
    let one = CartesianPendulum {
        mass: 0.7,
        gravity: 9.81,
        length: 1.0,
    };
    let start = state(&[1.0, 0.0], &[0.0, 0.0]);
    let (one, two) = (run(&one, start.clone(), 5.0), run(&two, start, 5.0));
    for k in 0..=20 {
        let t = 0.25 * f64::from(k);
        let (a, b) = (one.sampler().at(t), two.sampler().at(t));
        let (a, b) = (a.expect("inside"), b.expect("inside"));
        agree("x", b.state.q[0], a.state.q[0], 1e-10);
        agree("y", b.state.q[1], a.state.q[1], 1e-10);
        // Only what both do together is determined.
        agree("pull", b.forces[0] + 2.0 * b.forces[1], a.forces[0], 1e-9);
    }
}

#[test]
fn rods_that_contradict_each_other_are_refused() {
    let two = TwoRods {
        mass: 0.7,
        gravity: 9.81,
        length: 1.0,
        other: 1.5,
    };
    let refused = |project: bool| {
        Simulation::new(&two)
            .project_start(project)
            .run(state(&[1.0, 0.0], &[0.0, 0.0]), 0.0..1.0)
            .expect_err("no state satisfies both")
            .error
    };
    assert!(matches!(refused(false), Error::Start { item: "spare", .. }));
    assert!(matches!(refused(true), Error::Projection { .. }));
}
