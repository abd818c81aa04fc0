//! A constraint of velocity level that is no derivative: a skate on an incline.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, run};

/// A knife edge at (x, y) in the direction φ, x downhill.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = -mass * gravity * sin(slope) * x,
    constraint(edge: der(x) * sin(phi) == der(y) * cos(phi)),
)]
struct Skate {
    mass: f64,
    inertia: f64,
    gravity: f64,
    slope: f64,
}

/// Started at rest but for the turn ω it does not slide down: x = h sin² ωt, y = h (ωt − ½ sin 2ωt) with
/// h = g sin α/(2ω²) (Neimark & Fufaev 1972, chapter II).
#[test]
fn a_turning_skate_moves_sideways_on_a_cycloid() {
    let (gravity, slope, turn) = (9.81, 0.3_f64, 1.7);
    let scene = Skate {
        mass: 3.0,
        inertia: 0.4,
        gravity,
        slope,
    };
    let trajectory = run(&scene, state(&[0.0; 3], &[0.0, 0.0, turn]), 10.0);
    let height = gravity * slope.sin() / (2.0 * turn * turn);
    for k in 0..=100 {
        let t = 0.1 * f64::from(k);
        let phase = turn * t;
        let now = trajectory.sampler().at(t).expect("inside");
        agree("x", now.state.q[0], height * phase.sin().powi(2), 1e-10);
        agree(
            "y",
            now.state.q[1],
            height * (phase - 0.5 * (2.0 * phase).sin()),
            1e-10,
        );
        agree("φ", now.state.q[2], phase, 1e-11);
        // The edge gives what the turn of the velocity and gravity across it ask for.
        let across = 2.0 * 3.0 * gravity * slope.sin() * phase.sin();
        agree("force", now.forces[0].abs(), across.abs(), 1e-9);
    }
    assert!(closure(&trajectory) < 1e-11);
}
