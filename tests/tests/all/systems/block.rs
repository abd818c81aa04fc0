//! A block on an incline with Coulomb friction: stops or not, in closed form.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, run, words};

/// A block on an incline.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential = mass * gravity * (n * cos(slope) - s * sin(slope)),
    contact(plane: n >= 0),
    friction(grip on plane: slip = der(s), static = mu),
)]
struct Block {
    mass: f64,
    gravity: f64,
    slope: f64,
    mu: f64,
}

#[test]
fn a_block_on_an_incline_stops_and_stays_or_turns_back() {
    let block = Block {
        mass: 2.0,
        gravity: 9.81,
        slope: 0.4,
        mu: 0.7,
    };
    // tan 0.4 = 0.42 < 0.7: kicked downhill it stops after v²/(2a), a = g(μ cos − sin).
    let deceleration = 9.81 * (0.7 * 0.4_f64.cos() - 0.4_f64.sin());
    let trajectory = run(&block, state(&[0.0; 2], &[3.0, 0.0]), 10.0);
    assert_eq!(words(&trajectory), ["grip sticks"]);
    agree(
        "time",
        trajectory.events()[0].time,
        3.0 / deceleration,
        1e-12,
    );
    agree(
        "way",
        trajectory.final_state().q[0],
        4.5 / deceleration,
        1e-12,
    );
    assert_eq!(trajectory.final_state().v, [0.0, 0.0]);
    // μ = 0.3 < tan: kicked uphill it stops, turns and slides down.
    let block = Block { mu: 0.3, ..block };
    let trajectory = run(&block, state(&[0.0; 2], &[-3.0, 0.0]), 2.0);
    assert_eq!(words(&trajectory), ["grip reverses"]);
    let (up, down) = (
        9.81 * (0.4_f64.sin() + 0.3 * 0.4_f64.cos()),
        9.81 * (0.4_f64.sin() - 0.3 * 0.4_f64.cos()),
    );
    let turn = 3.0 / up;
    agree("turn", trajectory.events()[0].time, turn, 1e-12);
    agree(
        "way",
        trajectory.final_state().q[0],
        -4.5 / up + 0.5 * down * (2.0 - turn).powi(2),
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-12);
    // From rest with μ > tan nothing moves.
    let block = Block { mu: 0.5, ..block };
    let trajectory = run(&block, state(&[0.0; 2], &[0.0; 2]), 5.0);
    assert!(trajectory.events().is_empty());
    assert_eq!(trajectory.final_state().q, [0.0, 0.0]);
}

/// A block on a belt, held by a spring.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential = mass * gravity * n + stiffness/2 * s^2,
    contact(belt: n >= 0),
    friction(grip on belt: slip = der(s) - speed, static = mu_static, kinetic = mu_kinetic),
)]
struct Belt {
    mass: f64,
    gravity: f64,
    stiffness: f64,
    speed: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

/// Sticks until k s = μₛ m g, then s = s̄ + (s₁ − s̄) cos ωτ + (v/ω) sin ωτ about s̄ = μₖ m g/k, until ṡ = v again at
/// τ = 2 (π − atan(ω (s₁ − s̄)/v))/ω and s₂ = 2 s̄ − s₁; and so on.
#[test]
fn a_block_on_a_belt_sticks_and_slips_for_ever() {
    let belt = Belt {
        mass: 1.5,
        gravity: 9.81,
        stiffness: 40.0,
        speed: 0.2,
        mu_static: 0.5,
        mu_kinetic: 0.3,
    };
    let trajectory = run(&belt, state(&[0.0, 0.0], &[0.2, 0.0]), 20.0);
    let weight = 1.5 * 9.81;
    let (high, middle) = (0.5 * weight / 40.0, 0.3 * weight / 40.0);
    let omega = (40.0_f64 / 1.5).sqrt();
    let slide = 2.0 * (PI - (omega * (high - middle) / 0.2).atan()) / omega;
    let low = 2.0 * middle - high;
    let mut time = high / 0.2;
    let mut events = trajectory.events().iter();
    let mut cycles = 0;
    while time + slide < 20.0 {
        let slips = events.next().expect("a slip");
        assert_eq!(slips.kind, EventKind::Slips);
        agree("slips at", slips.time, time, 1e-10);
        agree("where", slips.state.q[0], high, 1e-10);
        let sticks = events.next().expect("a stick");
        assert_eq!(sticks.kind, EventKind::Sticks);
        agree("sticks at", sticks.time, time + slide, 1e-10);
        agree("where", sticks.state.q[0], low, 1e-10);
        time += slide + (high - low) / 0.2;
        cycles += 1;
    }
    assert!(cycles > 5);
    assert!(closure(&trajectory) < 1e-10);
}

/// Exactly at the limit tan α = μ, where sticking is just possible and just not.
#[test]
fn a_block_exactly_at_the_limit_has_an_answer() {
    for slope in [0.1_f64, 0.4, 0.9] {
        let block = Block {
            mass: 2.0,
            gravity: 9.81,
            slope,
            mu: slope.tan(),
        };
        let trajectory = run(&block, state(&[0.0; 2], &[0.0; 2]), 5.0);
        agree("it stays", trajectory.final_state().q[0], 0.0, 1e-12);
        // Sliding down it keeps its speed.
        let trajectory = run(&block, state(&[0.0; 2], &[1.0, 0.0]), 5.0);
        agree("it slides on", trajectory.final_state().v[0], 1.0, 1e-12);
    }
}

/// A block that is pulled ever harder.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential = mass * gravity * n,
    contact(plane: n >= 0),
    friction(grip on plane: slip = der(s), static = mu_static, kinetic = mu_kinetic),
    force(pull: s = rate * t),
)]
struct Pulled {
    mass: f64,
    gravity: f64,
    mu_static: f64,
    mu_kinetic: f64,
    rate: f64,
}

#[test]
fn a_block_that_is_pulled_ever_harder_starts_in_time() {
    for rate in [3.0_f64, -3.0] {
        let block = Pulled {
            mass: 2.0,
            gravity: 9.81,
            mu_static: 0.4,
            mu_kinetic: 0.25,
            rate,
        };
        let trajectory = run(&block, state(&[0.0; 2], &[0.0; 2]), 5.0);
        assert_eq!(words(&trajectory), ["grip slips"]);
        let start = 0.4 * 2.0 * 9.81 / rate.abs();
        agree("starts", trajectory.events()[0].time, start, 1e-12);
        // m v̇ = |rate| t − μₖ m g.
        let speed =
            (rate.abs() * (25.0 - start * start) / 2.0 - 0.25 * 2.0 * 9.81 * (5.0 - start)) / 2.0;
        agree(
            "v",
            trajectory.final_state().v[0],
            rate.signum() * speed,
            1e-12,
        );
        assert!(closure(&trajectory) < 1e-12);
    }
}
