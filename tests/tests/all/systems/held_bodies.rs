//! Bodies that friction holds on curved ground, in x and y: rounding of velocities that are zero is no turn.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, certified, methods_at, run_by, times, words};

/// A bead in a rough bowl, with a force that swings and is too small to move it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = 9.81*y,
    contact(bowl: 1 >= sqrt(x^2 + y^2)),
    friction(rub on bowl: slip = x*der(y) - y*der(x), static = rough),
    force(push: small*cos(rate*t) along der(x)),
    mark(turn: der(x)),
    mark(level: der(y)),
    stop(back: der(x) <= 0),
)]
struct Bowl {
    rough: f64,
    small: f64,
    rate: f64,
}

/// It slides down backwards and comes to rest: the stop, true at the start, never becomes false, and both velocities vanish once.
#[test]
fn nothing_turns_while_friction_holds() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let mut random = Random::new(41);
        for k in 0..10 {
            let scene = Bowl {
                rough: random.between(0.4, 0.9),
                small: random.between(0.05, 0.6),
                rate: random.between(1.0, 5.0),
            };
            let speed = random.between(0.3, 0.6);
            let (sin, cos) = 0.3_f64.sin_cos();
            let start = state(&[sin, -cos], &[-speed * cos, -speed * sin]);
            let run = run_by(&scene, (method, tolerance), start, 30.0);
            let asked = format!("{method} {tolerance:e}, {k}: {:?}", words(&run));
            assert_eq!(run.last_time(), 30.0, "{asked}");
            let rests = times(&run, "rub", "sticks");
            assert_eq!(rests.len(), 1, "{asked}");
            for mark in ["turn", "level"] {
                let late = times(&run, mark, "mark");
                assert!(late.iter().all(|t| *t <= rests[0] + 1e-9), "{asked}");
            }
            certified(asked, &run);
        }
    }
}

/// A block that a spring pulls over rough ground, which is curved, and a pendulum beside it: what swings turns while the other is held.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, swing),
    kinetic = (der(x)^2 + der(y)^2 + der(swing)^2)/2,
    potential = 9.81*y + 20*(1 - cos(swing)),
    constraint(ground: y == x^2/4),
    friction(rub on ground: slip = der(x) + x/2*der(y), static = 0.8),
    mark(turn: der(x)),
    mark(swings: der(swing)),
)]
struct Beside {}

#[test]
fn what_moves_beside_it_still_turns() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let start = state(&[0.5, 0.0625, 0.3], &[0.0; 3]);
        let run = run_by(&Beside {}, (method, tolerance), start, 10.0);
        let asked = format!("{method} {tolerance:e}: {:?}", words(&run));
        assert_eq!(times(&run, "turn", "mark").len(), 0, "{asked}");
        // ω² = 20 with small swings: a turn each 0.70 s.
        assert_eq!(times(&run, "swings", "mark").len(), 14, "{asked}");
    }
}
