//! Multiples of π of either sign in starts, stops, marks, forces and potentials.

use super::PI;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, event, run, words};

/// A rotor in oil.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta: "rad"),
    kinetic = inertia/2 * der(theta)^2,
    force(drag: theta = -6*pi*oil*der(theta)),
    start(down: theta = -pi/2, der(theta) = pi*rate),
    mark(level: theta >= -pi/6),
    stop(up: theta >= pi/2),
)]
struct Rotor {
    #[lagrange(unit = "kg m^2")]
    inertia: f64,
    #[lagrange(unit = "N m s")]
    oil: f64,
    #[lagrange(unit = "rad/s")]
    rate: f64,
}

/// θ = −π/2 + πn/k (1 − e⁻ᵏᵗ) with k = 6πη/I.
#[test]
fn a_rotor_in_oil_turns_half_round() {
    let rotor = Rotor {
        inertia: 0.3,
        oil: 0.02,
        rate: 2.0,
    };
    let trajectory = run(&rotor, rotor.at(Rotor::DOWN), 10.0);
    assert_eq!(words(&trajectory), ["level mark", "up stop"]);
    let k = 6.0 * PI * 0.02 / 0.3;
    for (item, kind, turned) in [("level", "mark", PI / 3.0), ("up", "stop", PI)] {
        let time = -(-turned * k / (2.0 * PI)).ln_1p() / k;
        agree(item, event(&trajectory, item, kind).time, time, 1e-11);
    }
}

/// A rotor in a field at an angle, without units.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = der(theta)^2 / 2,
    potential = field * sin(theta - pi/4),
    start(down: theta = -pi/2, der(theta) = rate),
    stop(up: theta >= pi/2),
)]
struct Needle {
    field: f64,
    rate: f64,
}

/// Half a turn takes V from −field/√2 to field/√2.
#[test]
fn a_needle_pays_for_half_a_turn() {
    let needle = Needle {
        field: 0.7,
        rate: 3.0,
    };
    let trajectory = run(&needle, needle.at(Needle::DOWN), 10.0);
    let end = trajectory.final_state();
    agree("θ", end.q[0], PI / 2.0, 1e-12);
    let rate = (9.0 - 2.0 * 0.7 * 2.0_f64.sqrt()).sqrt();
    agree("θ̇", end.v[0], rate, 1e-11);
}
