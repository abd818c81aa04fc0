//! The order in which coordinates are declared is no matter to any column of the equations.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, run_by};

/// A slow, a fast and a very fast overdamped mass in a row, the last one last.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    potential = (x^2 + (y - x)^2 + (z - y)^2) / 2,
    dissipation(drag: (a * der(x)^2 + b * der(y)^2 + c * der(z)^2) / 2),
)]
struct LastFast {
    a: f64,
    b: f64,
    c: f64,
}

/// The same, the last one first.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(z, y, x),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    potential = (x^2 + (y - x)^2 + (z - y)^2) / 2,
    dissipation(drag: (a * der(x)^2 + b * der(y)^2 + c * der(z)^2) / 2),
)]
struct FirstFast {
    a: f64,
    b: f64,
    c: f64,
}

/// An implicit method sees a wrong column of the Jacobian in its steps only, and only if that column is stiff.
#[test]
fn a_stiff_coordinate_costs_the_same_wherever_it_is_declared() {
    let (a, b, c) = (0.1, 30.0, 1e5);
    let method = ("radau5", 1e-8);
    let last = run_by(
        &LastFast { a, b, c },
        method,
        state(&[1.0, 0.5, -0.5], &[0.0; 3]),
        5.0,
    );
    let first = run_by(
        &FirstFast { a, b, c },
        method,
        state(&[-0.5, 0.5, 1.0], &[0.0; 3]),
        5.0,
    );
    let (one, other) = (last.work(), first.work());
    assert_eq!(one.steps, other.steps);
    assert_eq!(one.factorizations, other.factorizations);
    assert_eq!(one.evaluations, other.evaluations);
    let reversed = first.final_state().q.iter().rev();
    for (one, other) in last.final_state().q.iter().zip(reversed) {
        agree("q", *one, *other, 1e-11);
    }
    // Not fewer steps than the slow motion needs, and far fewer than 5 s times the rate 1e5 of the last coordinate.
    assert!(one.steps < 500, "{one:?}");
}
