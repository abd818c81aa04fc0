//! Slips of two components under normal forces and limits that are given.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, all_agree, closure, event, integral, run, run_by, words};

/// A puck pressed onto a table by a force that depends on place and time; friction that depends on speed.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    friction(pressed: slip = (der(x), der(y)), normal = press * (1 + x), static = mu),
)]
struct Pressed {
    mass: f64,
    press: f64,
    mu: f64,
}

/// v v′ = −(μ p/m)(1 + x u) along the line x = u ξ.
#[test]
fn a_given_normal_force() {
    let scene = Pressed {
        mass: 0.5,
        press: 2.0,
        mu: 0.3,
    };
    let (v0, u) = (1.1, [0.8, 0.6]);
    let trajectory = run(&scene, state(&[0.0; 2], &u.map(|u| u * v0)), 5.0);
    assert_eq!(words(&trajectory), ["pressed sticks"]);
    let k = scene.mu * scene.press / scene.mass;
    // ξ + u ξ²/2 = v₀²/(2 k)
    let way = ((1.0 + u[0] * v0 * v0 / k).sqrt() - 1.0) / u[0];
    all_agree(
        "place",
        &trajectory.final_state().q,
        &u.map(|u| u * way),
        1e-12,
    );
    let omega = (k * u[0]).sqrt();
    // ξ + 1/u oscillates with ω.
    let time = (omega * v0 / k).atan() / omega;
    agree(
        "time",
        event(&trajectory, "pressed", "sticks").time,
        time,
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-12);
}

/// A puck on a level table, pushed so that its slip is known: with s = ρ(t) u(t), u = (cos ω t, sin ω t), the push is
/// m (ρ̇ + μk g) u + m ρ ω u⊥.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(
        rho = jump * t + growth * t^2 / 2,
        forward = mass * (jump + growth * t + mu_kinetic * gravity),
        sideways = mass * rho * turn,
        c = cos(turn * t),
        s = sin(turn * t),
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    friction(grip: slip = (der(x), der(y)), normal = mass * gravity, static = mu_static, kinetic = mu_kinetic),
    force(push: (forward * c - sideways * s, forward * s + sideways * c) at (x, y)),
)]
struct Pushed {
    mass: f64,
    gravity: f64,
    jump: f64,
    growth: f64,
    turn: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

/// Slip that begins with a jump of its acceleration, smoothly, or in between; turning slowly, fast, and very fast.
#[test]
fn a_slip_begins_and_turns() {
    for (jump, growth) in [
        (1.0, 0.3),
        (0.0, 0.8),
        (1e-3, 0.5),
        (1e-6, 0.5),
        (0.0, 1e-3),
    ] {
        for turn in [0.5, 5.0, 40.0] {
            let mu_kinetic = 0.3;
            let mut scene = Pushed {
                mass: 0.7,
                gravity: 9.81,
                jump,
                growth,
                turn,
                mu_static: mu_kinetic + 0.5 * jump / 9.81,
                mu_kinetic,
            };
            if jump == 0.0 {
                scene.mu_static = mu_kinetic;
            }
            let until = 2.0;
            let trajectory = run(&scene, state(&[0.0; 2], &[0.0; 2]), until);
            assert_eq!(words(&trajectory), ["grip slips"], "{jump} {growth} {turn}");
            let rho = |t: f64| jump * t + 0.5 * growth * t * t;
            let end = trajectory.final_state();
            let (s, c) = (turn * until).sin_cos();
            let errors = [end.v[0] - rho(until) * c, end.v[1] - rho(until) * s];
            println!("{jump} {growth} {turn} {errors:?} {:?}", trajectory.work());
            all_agree("velocity", &end.v, &[rho(until) * c, rho(until) * s], 1e-11);
            let place = [
                integral(|t| rho(t) * (turn * t).cos(), 0.0, until),
                integral(|t| rho(t) * (turn * t).sin(), 0.0, until),
            ];
            all_agree("place", &end.q, &place, 1e-11);
            let after = &trajectory.events()[0].forces_after;
            all_agree("friction at first", after, &[-0.3 * 0.7 * 9.81, 0.0], 1e-9);
            assert!(closure(&trajectory) < 1e-10);
        }
    }
}

/// Friction with limits in newtons, and with coefficients that depend on speed and place.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(speed = sqrt(der(x)^2 + der(y)^2 + small^2)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = stiffness/2 * (x^2 + y^2),
    friction(seal: slip = (der(x), der(y)), limit = (high, low + (high - low) / (1 + (speed / stribeck)^2))),
)]
struct Seal {
    mass: f64,
    stiffness: f64,
    small: f64,
    high: f64,
    low: f64,
    stribeck: f64,
}

#[test]
fn limits_and_coefficients_that_depend_on_the_state() {
    let flat = Seal {
        mass: 1.0,
        stiffness: 9.0,
        small: 1e-3,
        high: 0.5,
        low: 0.5,
        stribeck: 0.2,
    };
    // Along a line: half swings lose 2 F/k each.
    let along = [0.6, 0.8];
    let trajectory = run(&flat, state(&along.map(|u| 0.5 * u), &[0.0; 2]), 20.0);
    assert_eq!(
        words(&trajectory),
        [
            "seal slips",
            "seal reverses",
            "seal reverses",
            "seal reverses",
            "seal sticks"
        ]
    );
    let last = trajectory.final_state();
    let place = 0.5 - 8.0 * 0.5 / 9.0;
    all_agree("rests", &last.q, &along.map(|u| u * place), 1e-11);
    // Off the line, with friction that falls with speed.
    let falling = Seal { low: 0.2, ..flat };
    let start = || state(&[0.6, 0.0], &[0.0, 1.0]);
    let trajectory = run(&falling, start(), 20.0);
    println!(
        "{:?} {:?} {}",
        words(&trajectory),
        trajectory.work(),
        closure(&trajectory)
    );
    assert!(closure(&trajectory) < 1e-11);
    let other = run_by(&falling, ("dop853", 1e-11), start(), 20.0);
    all_agree(
        "dop853",
        &trajectory.final_state().q,
        &other.final_state().q,
        1e-9,
    );
}
