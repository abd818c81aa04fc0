//! Bodies that touch and slide on side by side: nothing presses them together, and nothing tears them apart.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, certified, methods_at, run_by, words};

/// Two pucks on a rough table.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[2], y[2]),
    kinetic = sum(i in 0..2: mass/2 * (der(x[i])^2 + der(y[i])^2)),
    contact(touch: norm((x[1] - x[0], y[1] - y[0])) >= width),
    friction(cloth[i in 0..2]: slip = (der(x[i]), der(y[i])), normal = mass * 9.81, static = mu),
)]
struct Two {
    mass: f64,
    width: f64,
    mu: f64,
}

/// Three of them.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3], y[3]),
    kinetic = sum(i in 0..3: mass/2 * (der(x[i])^2 + der(y[i])^2)),
    contact(first: norm((x[1] - x[0], y[1] - y[0])) >= width),
    contact(second: norm((x[2] - x[1], y[2] - y[1])) >= width),
    friction(cloth[i in 0..3]: slip = (der(x[i]), der(y[i])), normal = mass * 9.81, static = mu),
)]
struct Three {
    mass: f64,
    width: f64,
    mu: f64,
}

/// How far a puck goes with a speed, and which one it has after a distance.
fn slides(mu: f64, speed: f64) -> f64 {
    speed * speed / (2.0 * mu * 9.81)
}

fn slowed(mu: f64, speed: f64, distance: f64) -> f64 {
    (speed * speed - 2.0 * mu * 9.81 * distance).sqrt()
}

/// After a plastic impact both have half the speed and come to rest together.
#[test]
fn a_puck_pushes_another_along_and_stays_with_it() {
    for (mass, mu, speed) in [
        (0.17, 0.2, 2.0),
        (0.085, 0.16, 2.0),
        (0.17, 0.2, 1.4),
        (0.3, 0.1, 3.0),
    ] {
        let scene = Two {
            mass,
            width: 0.057,
            mu,
        };
        let gone = slides(mu, slowed(mu, speed, 0.243) / 2.0);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = state(&[-0.3, 0.0, 0.0, 0.0], &[speed, 0.0, 0.0, 0.0]);
            let motion = run_by(&scene, (method, tolerance), start, 3.0);
            let what = format!("{scene:?} {speed} by {method} at {tolerance:e}");
            agree(&what, motion.final_state().q[1], gone, 10.0 * tolerance);
            if method == Method::Auto {
                let expected = [
                    "touch impact",
                    "touch closed",
                    "cloth[1] slips",
                    "cloth[0] sticks",
                    "cloth[1] sticks",
                ];
                assert_eq!(words(&motion), expected, "{what}");
            }
            certified(&what, &motion);
        }
    }
}

/// Of three, two of which lie touching, all have a third of the speed.
#[test]
fn a_puck_pushes_two_along() {
    for speed in [1.0, 1.3, 1.5, 1.7, 2.0, 2.5] {
        let scene = Three {
            mass: 0.17,
            width: 0.057,
            mu: 0.2,
        };
        let gone = slides(0.2, slowed(0.2, speed, 0.243) / 3.0);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = state(
                &[-0.3, 0.0, 0.057, 0.0, 0.0, 0.0],
                &[speed, 0.0, 0.0, 0.0, 0.0, 0.0],
            );
            let motion = run_by(&scene, (method, tolerance), start, 3.0);
            let what = format!("{speed} by {method} at {tolerance:e}");
            for (j, expected) in [gone - 0.057, gone, gone + 0.057].into_iter().enumerate() {
                agree(&what, motion.final_state().q[j], expected, 10.0 * tolerance);
            }
            certified(&what, &motion);
        }
    }
}
