//! A row of dominoes on hinges at their feet: the first one is pushed, and all fall against one another until they lie flat.

use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, first_start};

/// Four rods of unit length, on hinges at distances `apart`. At first the others lean back by `back`.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a[4]),
    kinetic = sum(k in 0..4: mass/6 * der(a[k])^2),
    potential = sum(k in 0..4: mass * gravity/2 * cos(a[k])),
    contact(hit[k in 0..3]: apart*cos(a[k+1]) - sin(a[k] - a[k+1]) >= 0, restitution = throws),
    contact(ground: a[3] <= pi/2),
    contact(rest[k in 1..4]: a[k] >= -back),
    friction(rub[k in 0..3] on hit[k]: slip = -der(a[k]) * sin(a[k] - a[k+1]), static = mu),
    impacts = in_turn,
    start(pushed: a[0] = 0, a[k in 1..4] = -back, der(a[0]) = push),
)]
struct Row {
    mass: f64,
    gravity: f64,
    apart: f64,
    mu: f64,
    throws: f64,
    push: f64,
    back: f64,
}

/// What lies flat on another has no arm to rub with: a friction that the last bounces were to leave sticking there would have to hold what moves on.
#[test]
fn dominoes_that_bounce_on_one_another_end_flat() {
    let rows = [
        [0.54, 0.107, 0.395, 1.82, 0.044],
        [0.637, 0.108, 0.411, 1.44, 0.092],
        [0.661, 0.187, 0.431, 2.83, 0.036],
        [0.682, 0.351, 0.356, 2.15, 0.073],
    ];
    for [apart, mu, throws, push, back] in rows {
        let scene = Row {
            mass: 0.2,
            gravity: 9.81,
            apart,
            mu,
            throws,
            push,
            back,
        };
        let trajectory = Simulation::new(&scene)
            .run(first_start(&scene), 0.0..3.0)
            .unwrap_or_else(|failure| panic!("{scene:?}: {failure}"));
        let end = trajectory.final_state();
        for (q, v) in end.q.iter().zip(&end.v) {
            agree("angle", *q, core::f64::consts::FRAC_PI_2, 1e-9);
            agree("rate", *v, 0.0, 1e-9);
        }
        assert!(closure(&trajectory) < 1e-8);
    }
}
