//! Marks at poles, where an angle has no inertia; and what comes true with the last of impacts that accumulate.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, times};

/// A pendulum in space by two angles.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta, phi),
    kinetic = length^2/2 * (der(theta)^2 + sin(theta)^2 * der(phi)^2),
    potential = -9.81*length*cos(theta),
    mark(below: theta <= 0),
    mark(lowest: theta),
)]
struct Spherical {
    length: f64,
}

/// A pendulum in its plane.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = length^2/2 * der(theta)^2,
    potential = -9.81*length*cos(theta),
    mark(below: theta <= 0),
    mark(lowest: theta),
)]
struct Plane {
    length: f64,
}

#[test]
fn a_pendulum_in_space_is_marked_as_it_passes_its_pole() {
    for (length, from) in [(1.0, 1.0), (0.7, 0.4), (1.3, 2.0)] {
        let plane = run_by(
            &Plane { length },
            ("auto", 1e-13),
            state(&[from], &[0.0]),
            7.0,
        );
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{length} {from} by {method} at {tolerance:e}");
            let start = state(&[from, 0.0], &[0.0; 2]);
            let run = run_by(&Spherical { length }, (method, tolerance), start, 7.0);
            for mark in ["below", "lowest"] {
                let (found, right) = (times(&run, mark, "mark"), times(&plane, mark, "mark"));
                assert_eq!(
                    found.len(),
                    right.len(),
                    "{what}: {mark} {found:?} {right:?}"
                );
                for (found, right) in found.into_iter().zip(right) {
                    agree(&what, found, right, 300.0 * tolerance);
                }
            }
            certified(&what, &run);
        }
    }
}

/// A ball that bounces until it lies.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2/2,
    potential = gravity*y,
    contact(floor: y >= 0, restitution = bounce),
    mark(told: t >= late),
    stop(ends: t >= later),
)]
struct Ball {
    gravity: f64,
    bounce: f64,
    late: f64,
    later: f64,
}

/// It lies at √(2h/g) (1 + e)/(1 − e). A mark some units of rounding beside that instant is passed once.
#[test]
fn what_comes_true_as_impacts_end_is_told() {
    let mut random = Random::new(3);
    for case in 0..30 {
        let height = (5 + random.below(50)) as f64 / 10.0;
        let bounce = (3 + random.below(6)) as f64 / 10.0;
        let gravity = [9.81, 10.0][case % 2];
        let lies = (2.0 * height / gravity).sqrt() * (1.0 + bounce) / (1.0 - bounce);
        let units = random.below(25) as f64 - 12.0;
        let at = lies * (1.0 + units * f64::EPSILON);
        for (late, later, until) in [(at, 2.0 * at, 1.5 * at), (0.5 * at, at, 1.5 * at)] {
            let scene = Ball {
                gravity,
                bounce,
                late,
                later,
            };
            for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
                let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
                let run = run_by(&scene, (method, tolerance), state(&[height], &[0.0]), until);
                let [marked] = times(&run, "told", "mark")[..] else {
                    panic!("{what}: {:?}", times(&run, "told", "mark"));
                };
                agree(&what, marked, late, 1e-13 + 1e-3 * tolerance);
                assert_eq!(
                    times(&run, "ends", "stop").len(),
                    usize::from(later < until),
                    "{what}"
                );
                certified(&what, &run);
            }
        }
    }
}
