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

/// A ball that bounces without loss, whose highest and lowest points are marked.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = 1),
    mark(turn: der(y)),
    mark(high: y >= gravity / 16),
    start(thrown: der(x) = 1, der(y) = gravity / 2),
)]
struct Thrown {
    gravity: f64,
}

/// The ball turns each half second, every second time because it hits the floor, and rises to half of its height √(1/8) s before each highest point.
#[test]
fn a_run_that_ends_after_a_mark_ends_at_its_instant() {
    let scene = Thrown { gravity: 9.81 };
    let start = scene.at(Thrown::THROWN);
    for method in METHODS {
        let simulation = || Simulation::new(&scene).method(method).tolerance(1e-11);
        for number in [1, 2, 3] {
            let count = f64::from(number);
            let rises = count - 0.5 - 0.125_f64.sqrt();
            for (mark, time) in [(Thrown::TURN, count / 2.0), (Thrown::HIGH, rises)] {
                let what = format!("{method}, number {number}");
                let awaited = (mark, EventKind::Mark, number as usize);
                let asked = [
                    simulation().end_after(awaited),
                    simulation().error(1e-8).end_after(awaited),
                ];
                for simulation in asked {
                    let run = simulation.run(start.clone(), 0.0..9.0).expect("a run");
                    let last = run.events().last().expect("a mark");
                    assert_eq!(last.subject, Subject::from(mark), "{what}");
                    assert_eq!(last.time, run.last_time(), "{what}");
                    agree(&what, last.time, time, 1e-9);
                    agree(&what, run.final_state().q[0], time, 1e-9);
                    certified(&what, &run);
                }
            }
        }
    }
}
