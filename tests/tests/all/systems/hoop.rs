//! A bead on a turning hoop: a constraint that contains time.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, run};

/// A bead on a hoop that is turned about its vertical diameter at a given rate.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    constraint(sphere: x^2 + y^2 + z^2 == radius^2),
    constraint(plane: x * sin(rate * t) == y * cos(rate * t)),
)]
struct Hoop {
    mass: f64,
    gravity: f64,
    radius: f64,
    rate: f64,
}

/// The same with one coordinate, θ from the bottom.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * radius^2 * (der(theta)^2 + rate^2 * sin(theta)^2),
    potential = -mass * gravity * radius * cos(theta),
)]
struct ReducedHoop {
    mass: f64,
    gravity: f64,
    radius: f64,
    rate: f64,
}

#[test]
fn a_bead_on_a_turning_hoop_agrees_with_its_one_coordinate() {
    let (mass, gravity, radius, rate) = (0.4, 9.81, 0.8, 5.0);
    let hoop = Hoop {
        mass,
        gravity,
        radius,
        rate,
    };
    let theta: f64 = 0.6;
    let start = state(
        &[radius * theta.sin(), 0.0, -radius * theta.cos()],
        &[0.0, radius * theta.sin() * rate, 0.0],
    );
    let full = run(&hoop, start, 4.0);
    let reduced = run(
        &ReducedHoop {
            mass,
            gravity,
            radius,
            rate,
        },
        state(&[theta], &[0.0]),
        4.0,
    );
    let (q, th) = (&full.final_state().q, reduced.final_state().q[0]);
    agree("z", q[2], -radius * th.cos(), 1e-10);
    agree("x", q[0], radius * th.sin() * (4.0 * rate).cos(), 1e-10);
    // The plane does work; the Jacobi integral of the reduced bead stays.
    assert!(closure(&full) < 1e-10, "{}", closure(&full));
    let ledger = full.ledger().expect("sampled");
    let plane = ledger
        .work
        .iter()
        .find(|e| e.name == "plane")
        .expect("the plane");
    agree(
        "work of the plane",
        plane.work,
        ledger.end.jacobi - ledger.start.jacobi,
        1e-10,
    );
    assert!(closure(&reduced) < 1e-12);
}
