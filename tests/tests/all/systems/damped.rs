//! Rayleigh damping and driving forces.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::extrapolate;
use lagrange_tests::{agree, closure, run};

/// A pendulum in a viscous medium.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
    dissipation(air: drag/2 * der(theta)^2),
)]
struct Damped {
    mass: f64,
    gravity: f64,
    length: f64,
    drag: f64,
}

#[test]
fn a_damped_pendulum_agrees_with_an_integration_apart() {
    let scene = Damped {
        mass: 0.6,
        gravity: 9.81,
        length: 0.9,
        drag: 0.2,
    };
    let inertia = 0.6 * 0.9 * 0.9;
    let slope = |_: f64, y: &[f64; 3]| {
        let torque = -0.6 * 9.81 * 0.9 * y[0].sin() - 0.2 * y[1];
        [y[1], torque / inertia, -0.2 * y[1] * y[1]]
    };
    let [theta, omega, work] = extrapolate(slope, 0.0, 6.0, [2.5, 0.0, 0.0], 60);
    let trajectory = run(&scene, state(&[2.5], &[0.0]), 6.0);
    agree("θ", trajectory.final_state().q[0], theta, 1e-10);
    agree("θ̇", trajectory.final_state().v[0], omega, 1e-10);
    let ledger = trajectory.ledger().expect("sampled");
    agree("work of the air", ledger.work[0].work, work, 1e-10);
    assert!(closure(&trajectory) < 1e-11);
}

/// A driven oscillator.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = stiffness/2 * x^2,
    dissipation(oil: damping/2 * der(x)^2),
    force(drive: x = amplitude * cos(rate * t)),
)]
struct Driven {
    mass: f64,
    stiffness: f64,
    damping: f64,
    amplitude: f64,
    rate: f64,
}

/// The steady oscillation x = A cos(ωt − δ) when started on it, from any first time.
#[test]
fn a_driven_oscillator_stays_in_its_steady_state() {
    let scene = Driven {
        mass: 1.3,
        stiffness: 20.0,
        damping: 0.4,
        amplitude: 2.0,
        rate: 5.0,
    };
    let (stiff, damp) = (20.0 - 1.3 * 25.0_f64, 0.4 * 5.0_f64);
    let amplitude = 2.0 / stiff.hypot(damp);
    let lag = damp.atan2(stiff);
    let place = |t: f64| amplitude * (5.0 * t - lag).cos();
    let speed = |t: f64| -5.0 * amplitude * (5.0 * t - lag).sin();
    for first in [0.0, 1.7, -30.0] {
        let trajectory = Simulation::new(&scene)
            .tolerance(1e-12)
            .run(state(&[place(first)], &[speed(first)]), first..first + 8.0)
            .expect("smooth");
        agree(
            "x",
            trajectory.final_state().q[0],
            place(first + 8.0),
            1e-10,
        );
        agree(
            "v",
            trajectory.final_state().v[0],
            speed(first + 8.0),
            1e-10,
        );
        assert!(closure(&trajectory) < 1e-11);
        // In a steady state the drive gives what the oil takes, over whole periods.
        let whole = 5.0 * 2.0 * core::f64::consts::PI / 5.0;
        let ledger = Simulation::new(&scene)
            .tolerance(1e-12)
            .run(
                state(&[place(first)], &[speed(first)]),
                first..first + whole,
            )
            .expect("smooth")
            .ledger()
            .expect("sampled");
        agree("balance", ledger.work[0].work, -ledger.work[1].work, 1e-10);
        // ½ c (A ω)² over five periods.
        let heat = 0.5 * 0.4 * (5.0 * amplitude).powi(2) * whole;
        agree("heat", -ledger.work[1].work, heat, 1e-10);
    }
}
