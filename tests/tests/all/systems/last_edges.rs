//! Motions that end, or turn, exactly at the edge of a surface, as round numbers have it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, times, words,
};

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

/// A box that slides over the end of a table and tips: its lower corners touch the table, and the edge of the table its lower face.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, turn),
    define(
        rear_x = x - wide*cos(turn) + tall*sin(turn),
        rear_y = y - wide*sin(turn) - tall*cos(turn),
        front_x = x + wide*cos(turn) + tall*sin(turn),
        front_y = y + wide*sin(turn) - tall*cos(turn),
        beneath = (1 + drift*t - x)*cos(turn) - y*sin(turn),
        below = (1 + drift*t - x)*sin(turn) + y*cos(turn),
    ),
    kinetic = (der(x)^2 + der(y)^2)/2 + inertia/2*der(turn)^2,
    potential = 10*y,
    contact(rear: rear_y >= 0, where rear_x <= 1 + drift*t),
    contact(front: front_y >= 0, where front_x <= 1 + drift*t),
    contact(edge: below >= tall, where wide^2 >= beneath^2),
    start(slides: x = from, y = tall, der(x) = speed + drift),
)]
struct OverTheEnd {
    wide: f64,
    tall: f64,
    inertia: f64,
    from: f64,
    speed: f64,
    drift: f64,
}

/// Its rear corner passes the edge just as the edge leaves its face: nothing is hit there.
#[test]
fn the_last_corner_of_a_box_passes_the_end_of_a_table() {
    for (wide, tall, inertia, from, speed, drift) in [
        (0.3, 0.05, 0.05, 0.6, 1.0, 0.0),
        (0.1, 0.2, 0.05, 0.8, 0.39, -2.0),
        (0.3, 0.2, 0.02, 0.9, 0.7, 1.0),
        (0.5, 0.4, 0.05, 0.8, 0.3, 0.0),
    ] {
        let body = OverTheEnd {
            wide,
            tall,
            inertia,
            from,
            speed,
            drift,
        };
        // It tips from where its centre passes the edge, and has left it when its angle is about 1.
        let end = (1.0 - from) / speed + 0.75 * wide / speed.max(0.5) + 0.1;
        let runs: Vec<_> = methods_at(METHODS, TOLERANCES)
            .map(|(method, tolerance)| {
                let what = format!("{body:?} by {method} at {tolerance:e}");
                let run = run_by(&body, (method, tolerance), body.at(OverTheEnd::SLIDES), end);
                for corner in ["rear", "front"] {
                    assert!(
                        times(&run, corner, "impact").is_empty(),
                        "{what}: {:?}",
                        words(&run)
                    );
                }
                certified(&what, &run);
                (what, tolerance, run.final_state().clone())
            })
            .collect();
        let (_, coarse, first) = &runs[0];
        for (what, tolerance, last) in &runs {
            for j in 0..3 {
                agree(what, last.q[j], first.q[j], 1e4 * tolerance.max(*coarse));
            }
        }
    }
}
