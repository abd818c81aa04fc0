//! What is held rubs on a plate that moves by time: the slip passes zero at instants that the motion does not know of, and its friction turns there.

use super::state;
use core::f64::consts::TAU;
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, all_agree, certified, methods_at, run_by, times,
};

/// A block that a rod holds along x and that is free along y, on a plate that shakes along x beside a drift.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    define(plate = drift + size*cos(rate*t)),
    constraint(rod: x == 0),
    friction(rub: slip = (der(x) - plate, der(y)), limit = limit),
)]
struct Held {
    mass: f64,
    limit: f64,
    drift: f64,
    size: f64,
    rate: f64,
}

#[test]
fn friction_on_what_is_held_turns_with_its_plate() {
    let mut random = Random::new(12);
    for case in 0..12 {
        let size = random.between(0.5, 2.0);
        let scene = Held {
            mass: random.between(0.2, 5.0),
            limit: random.between(0.1, 2.0),
            drift: [0.0, 0.4, -0.995][case % 3] * size,
            size,
            rate: random.between(1.0, 4.0),
        };
        // The plate turns where its cosine is −drift/size.
        let turn = (-scene.drift / scene.size).acos();
        let until = 0.99 * 2.0 * TAU / scene.rate;
        let rounds = [0.0, TAU];
        let turns = rounds.map(|round| [round + turn, round + TAU - turn]);
        let turns = turns.into_iter().flatten().map(|phase| phase / scene.rate);
        let expected: Vec<f64> = turns.filter(|turn| *turn < until).collect();
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let start = state(&[0.0; 2], &[0.0; 2]);
            let run = run_by(&scene, (method, tolerance), start, until);
            let turns = times(&run, "rub", "reverses");
            all_agree(&what, &turns, &expected, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}
