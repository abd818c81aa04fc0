//! Bodies that friction holds on curved ground, in x and y: rounding of velocities that are zero is no turn.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, times, words,
};

/// A bead in a rough bowl, with a force that swings and is too small to move it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
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
    emit = data,
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

/// A mass that is thrown down beside a wall, pulled to it by a spring, and lands on a floor that keeps it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass*gravity*y + spring/2*x^2,
    contact(floor: y >= 0),
    contact(wall: x <= side),
    stop(landed: der(y) >= 0),
    mark(met: der(x) <= 0),
)]
struct Thrown {
    mass: f64,
    gravity: f64,
    spring: f64,
    side: f64,
}

/// It is above the floor when it begins, and the floor takes all of its velocity: `der(y) >= 0` becomes true there, and stays so.
#[test]
fn what_an_impact_ends_has_ended() {
    for (gravity, height, speed) in [(9.81, 1.0, 0.1), (1.62, 0.3, 2.0), (24.8, 2.0, 0.5)] {
        let lands = ((speed * speed + 2.0 * gravity * height).sqrt() - speed) / gravity;
        let spring = 3.0 / (lands * lands);
        // From the middle with the rate v the wall at v sin(ωt)/ω is met after half of the fall.
        let w = (spring / 0.7_f64).sqrt();
        let thrown = Thrown {
            mass: 0.7,
            gravity,
            spring,
            side: (0.5 * w * lands).sin() / w,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{thrown:?} by {method:?} at {tolerance:e}");
            let start = state(&[0.0, height], &[1.0, -speed]);
            let run = run_by(&thrown, (method, tolerance), start, 10.0);
            agree(&what, run.last_time(), lands, 10.0 * tolerance);
            let met = times(&run, "met", "mark");
            assert_eq!(met.len(), 1, "{what}: {:?}", words(&run));
            agree(&what, met[0], 0.5 * lands, 10.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A body that friction holds on curved ground under a force that swings, and a crank that is turned to and fro beside it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, crank),
    kinetic = (der(x)^2 + der(y)^2 + der(crank)^2)/2,
    potential = 9.81*y,
    contact(ground: y >= sin(x)/5),
    friction(rub on ground: slip = der(x) + cos(x)/5*der(y), static = 0.9),
    constraint(turn: crank == cos(rate*t + phase)),
    force(push: small*sin(5*t) along der(x)),
    mark(turns: der(x)),
    mark(cranks: der(crank)),
    stop(slides: der(x) >= 0),
)]
struct BesideCrank {
    rate: f64,
    phase: f64,
    small: f64,
}

/// Nothing of the body turns or slides, whatever is driven elsewhere, and whether that stands at its dead centre as the run begins.
#[test]
fn what_is_driven_elsewhere_moves_nothing_that_is_held() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let mut random = Random::new(65);
        for k in 0..6 {
            let scene = BesideCrank {
                rate: random.between(1.0, 5.0),
                phase: if k % 2 == 0 { 0.0 } else { 1.0 },
                small: random.between(0.1, 2.0),
            };
            let x = random.between(0.1, 0.5);
            let turning = -scene.rate * scene.phase.sin();
            let start = state(&[x, x.sin() / 5.0, scene.phase.cos()], &[0.0, 0.0, turning]);
            let run = run_by(&scene, (method, tolerance), start, 5.0);
            let asked = format!("{method} {tolerance:e}, {k}: {:?}", words(&run));
            assert_eq!(run.last_time(), 5.0, "{asked}");
            assert_eq!(times(&run, "turns", "mark").len(), 0, "{asked}");
            // The crank turns wherever its phase is a multiple of π, but for the start.
            let turns = (scene.rate * 5.0 + scene.phase) / core::f64::consts::PI;
            let turned = times(&run, "cranks", "mark").len();
            assert_eq!(turned, turns as usize, "{asked}");
            certified(asked, &run);
        }
    }
}
