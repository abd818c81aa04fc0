//! Motions that end, or turn, exactly at the edge of a surface, as round numbers have it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by};

/// A block that slides along a table and is pushed back by a wind.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(table: y >= 0, where x <= length),
    friction(grip on table: slip = der(x), static = mu),
    force(wind: -push along der(x)),
)]
struct Block {
    length: f64,
    gravity: f64,
    mu: f64,
    push: f64,
}

fn tenths(random: &mut Random, low: usize, many: usize) -> f64 {
    (low + random.below(many)) as f64 / 10.0
}

/// Rounding says whether it is on the table still: it stays where it has stopped, or falls from there.
#[test]
fn a_block_that_stops_at_the_edge_stays_or_falls() {
    let mut random = Random::new(7);
    for case in 0..25 {
        let (speed, mu) = (tenths(&mut random, 3, 28), tenths(&mut random, 1, 7));
        let gravity = [9.81, 10.0][case % 2];
        let scene = Block {
            length: speed * speed / (2.0 * mu * gravity),
            gravity,
            mu,
            push: 0.0,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 2], &[speed, 0.0]),
                4.0,
            );
            let end = run.final_state();
            let stays = end.q[1].abs() <= tolerance;
            assert!(stays || end.q[1] < -1.0, "{what}: {end:?}");
            // An error of the place is the square of one of the speed with which it flies on.
            let known = match stays {
                true => 20.0 * tolerance,
                false => 20.0 * tolerance.sqrt(),
            };
            agree(&what, end.q[0], scene.length, known);
            certified(&what, &run);
        }
    }
}

/// It goes back as it came, or is lost there and falls.
#[test]
fn a_block_that_turns_at_the_edge_goes_back_or_falls() {
    let mut random = Random::new(8);
    for case in 0..25 {
        let (speed, push) = (tenths(&mut random, 3, 28), tenths(&mut random, 10, 80));
        let scene = Block {
            length: speed * speed / (2.0 * push),
            gravity: 9.81,
            mu: 0.0,
            push,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let until = 2.0 * speed / push;
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 2], &[speed, 0.0]),
                until,
            );
            let end = run.final_state();
            agree(&what, end.q[0], 0.0, 100.0 * tolerance);
            assert!(
                end.q[1].abs() <= tolerance || end.q[1] < -0.01,
                "{what}: {end:?}"
            );
            certified(&what, &run);
        }
    }
}
