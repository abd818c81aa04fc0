//! Marks at instants where something else happens as well: where a contact closes, and where the run ends.

use super::state;
use core::f64::consts::PI;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, certified, methods_at, run_by};

/// What was marked, and when.
fn marks(run: &Trajectory) -> Vec<(&'static str, f64)> {
    let marks = run.events().iter().filter(|e| e.kind == EventKind::Mark);
    marks
        .map(|e| (e.subject.name(run.description()), e.time))
        .collect()
}

/// A block falls onto the floor, and is pressed onto it more and more from t = 2 on.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = mass * der(y)^2 / 2,
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    force(press: y = if(t >= 2, -rate * (t - 2), 0)),
    mark(landed: closed(floor) and floor >= light),
    mark(heavy: closed(floor) and floor >= most),
)]
struct Block {
    mass: f64,
    gravity: f64,
    rate: f64,
    light: f64,
    most: f64,
}

#[test]
fn what_a_landing_makes_true_is_marked_once() {
    let gravity = 9.81;
    for (mass, height) in [(1.0, 1.0), (3.44, 0.49), (0.6, 2.3)] {
        let weight = mass * gravity;
        let block = Block {
            mass,
            gravity,
            rate: 20.0 * mass,
            light: 0.5 * weight,
            most: 2.0 * weight,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let run = run_by(&block, (method, tolerance), state(&[height], &[0.0]), 4.0);
            let what = format!("{method}, {tolerance:e}");
            let marks = marks(&run);
            let names: Vec<_> = marks.iter().map(|(name, _)| *name).collect();
            assert_eq!(names, ["landed", "heavy"], "{what}");
            let lands = (2.0 * height / gravity).sqrt();
            agree(&what, marks[0].1, lands, 10.0 * tolerance);
            agree(&what, marks[1].1, 2.0 + gravity / 20.0, 10.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A mass that is thrown to where it comes down, at x = `last`, when t = `last`.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    mark(instant: t - last),
    mark(late: t >= last),
    mark(wave: sin(pi * t / last)),
    mark(place: x - last),
    mark(far: x >= last),
    mark(down: y),
)]
struct Throw {
    gravity: f64,
    last: f64,
}

#[test]
fn what_is_passed_with_the_end_is_marked() {
    for last in [1.7, 2.0, 2.7, 3.0] {
        let throw = Throw {
            gravity: 9.81,
            last,
        };
        let start = state(&[0.0, 0.0], &[1.0, 0.5 * 9.81 * last]);
        for method in METHODS {
            let run = run_by(&throw, (method, 1e-12), start.clone(), last);
            let mut marks = marks(&run);
            let what = format!("{method} until {last}: {marks:?}");
            for (_, time) in &marks {
                agree(&what, *time, last, 1e-11);
            }
            marks.sort_by_key(|(name, _)| *name);
            let names = marks.iter().map(|(name, _)| *name);
            let all = ["down", "far", "instant", "late", "place", "wave"];
            assert!(names.eq(all), "{what}");
            certified(&what, &run);
        }
    }
}

/// A mass that runs to where the run would end in any case.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    stop(there: x >= last),
    mark(beyond: x >= further),
)]
struct Sprinter {
    last: f64,
    further: f64,
}

#[test]
fn a_stop_at_the_end_is_one_and_what_follows_is_not() {
    for last in [1.7, 2.5, PI] {
        let sprinter = Sprinter {
            last,
            further: last * (1.0 + 1e-9),
        };
        for method in METHODS {
            let run = run_by(&sprinter, (method, 1e-12), state(&[0.0], &[1.0]), last);
            let kinds: Vec<_> = run.events().iter().map(|event| event.kind).collect();
            assert_eq!(kinds, [EventKind::Stop], "{method} until {last}");
        }
    }
}
