//! What an impact elsewhere, or the motion of everything together, leaves as it is.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, all_agree, certified, methods_at, run_by, times};

/// A block that dry friction of given strength keeps on a shaken table, and far from it a ball that bounces.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2)/2,
    potential = 9.81*z + spring*x^2/2,
    contact(floor: z >= 0, restitution = bounce),
    friction(grip: slip = der(x) - way*rate*cos(rate*t), limit = strength),
    friction(guide: slip = x*der(x) - der(y), limit = strength),
    start(go: z = height, der(x) = way*rate),
)]
struct Shaken {
    way: f64,
    rate: f64,
    strength: f64,
    height: f64,
    bounce: f64,
    spring: f64,
}

#[test]
fn a_block_sticks_on_through_impacts_elsewhere() {
    for (way, rate, strength, height, bounce, spring) in [
        (0.086, 5.81, 21.9, 0.348, 0.8, 5.0),
        (0.1, 8.0, 30.0, 0.5, 1.0, 0.0),
        (0.05, 3.3, 9.0, 0.2, 0.6, 2.0),
    ] {
        let scene = Shaken {
            way,
            rate,
            strength,
            height,
            bounce,
            spring,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), scene.at(Shaken::GO), 1.1);
            for item in ["grip", "guide"] {
                assert!(times(&run, item, "slips").is_empty(), "{what}: {item}");
            }
            let x = way * (1.1 * rate).sin();
            agree(&what, run.final_state().q[0], x, 100.0 * tolerance);
            agree(
                &what,
                run.final_state().q[1],
                x * x / 2.0,
                100.0 * tolerance,
            );
            certified(&what, &run);
        }
    }
}

/// Three balls on a rough table, which may move; two of them touch.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[3], y[3]),
    kinetic = sum(k in 0..3: 1/2*(der(x[k])^2 + der(y[k])^2)),
    contact(first: sqrt((x[1] - x[0])^2 + (y[1] - y[0])^2) >= 2*radius),
    contact(second: sqrt((x[2] - x[1])^2 + (y[2] - y[1])^2) >= 2*radius),
    friction(cloth[k in 0..3]: slip = (der(x[k]) - table, der(y[k])), normal = 9.81, static = mu),
)]
struct Balls {
    radius: f64,
    mu: f64,
    table: f64,
}

/// On a table that moves evenly everything is as on one that rests.
#[test]
fn balls_that_touch_are_struck_on_a_moving_table_as_on_one_at_rest() {
    for (table, angle, off) in [(0.0, 0.5, 0.0), (0.4, 0.5, 0.0), (-1.3, 0.9, 0.01)] {
        let balls = Balls {
            radius: 0.03,
            mu: 0.02,
            table,
        };
        let rests = Balls {
            table: 0.0,
            ..balls
        };
        let (x, y) = (0.1 + 0.06 * f64::cos(angle), 0.06 * f64::sin(angle));
        let start = |v: f64| {
            let speeds = [2.0 + v, v, v, 0.0, 0.0, 0.0];
            state(&[-0.3, 0.1, x, off, 0.0, y], &speeds)
        };
        for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
            let what = format!("{balls:?} by {method} at {tolerance:e}");
            let moved = run_by(&balls, (method, tolerance), start(table), 0.3);
            let still = run_by(&rests, (method, tolerance), start(0.0), 0.3);
            let mut expected = still.final_state().q.clone();
            expected[..3].iter_mut().for_each(|x| *x += 0.3 * table);
            all_agree(&what, &moved.final_state().q, &expected, 1e3 * tolerance);
            certified(&what, &moved);
        }
    }
}
