//! A plate on three legs that slides and spins: three slips of two components that come to rest together.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{SINGLE_METHODS, agree, all_agree, closure, methods_at, run, run_by, words};

/// Each leg carries a third of the weight.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    define(px[k in 0..3] = x + r * cos(phi + 2 * pi * k / 3), py[k in 0..3] = y + r * sin(phi + 2 * pi * k / 3)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    friction(leg[k in 0..3]: slip = (der(px[k]), der(py[k])), normal = mass * gravity / 3, static = mu),
)]
struct Plate {
    mass: f64,
    inertia: f64,
    r: f64,
    gravity: f64,
    mu: f64,
}

const PLATE: Plate = Plate {
    mass: 2.0,
    inertia: 0.05,
    r: 0.2,
    gravity: 9.81,
    mu: 0.3,
};

/// The time at which all legs rest.
fn rest(trajectory: &Trajectory) -> f64 {
    let mut told = words(trajectory);
    told.sort();
    assert_eq!(told, ["leg[0] sticks", "leg[1] sticks", "leg[2] sticks"]);
    trajectory.events()[2].time
}

#[test]
fn it_spins_down() {
    let trajectory = run(&PLATE, state(&[0.0; 3], &[0.0, 0.0, 8.0]), 3.0);
    let rate = PLATE.mu * PLATE.mass * PLATE.gravity * PLATE.r / PLATE.inertia;
    agree("time", rest(&trajectory), 8.0 / rate, 1e-12);
    agree("turned", trajectory.final_state().q[2], 32.0 / rate, 1e-12);
    assert!(closure(&trajectory) < 1e-12);
}

#[test]
fn it_slides() {
    let trajectory = run(&PLATE, state(&[0.0; 3], &[1.2, -0.9, 0.0]), 3.0);
    let rate = PLATE.mu * PLATE.gravity;
    agree("time", rest(&trajectory), 1.5 / rate, 1e-12);
    all_agree(
        "place",
        &trajectory.final_state().q,
        &[1.2 * 0.75 / rate, -0.9 * 0.75 / rate, 0.0],
        1e-12,
    );
}

/// Sliding and spinning end together, or a leg stops first and the plate turns about it; all methods agree when and where.
#[test]
fn it_slides_and_spins() {
    for (v, w) in [(1.5, 3.0), (0.3, 9.0), (2.0, 0.1)] {
        let start = || state(&[0.0, 0.0, 0.1], &[v, 0.0, w]);
        let trajectory = run(&PLATE, start(), 5.0);
        let first = trajectory.events()[0].time;
        println!(
            "{:?} {:?} {:e}",
            words(&trajectory),
            trajectory.work(),
            rest(&trajectory) - first
        );
        let time = rest(&trajectory);
        assert!(closure(&trajectory) < 1e-11);
        let end = trajectory.final_state();
        for tolerance in [1e-10, 1e-11, 1e-13] {
            let other = Simulation::new(&PLATE)
                .tolerance(tolerance)
                .run(start(), 0.0..5.0)
                .unwrap_or_else(|e| panic!("{e}"));
            all_agree("taylor", &other.final_state().q, &end.q, 1e-9);
            agree("time", rest(&other), time, 1e-9);
        }
        for (method, bound) in [("dop853", 1e-9), ("verner98", 1e-9), ("radau5", 1e-8)] {
            let other = run_by(&PLATE, (method, 1e-11), start(), 5.0);
            all_agree(method, &other.final_state().q, &end.q, bound);
        }
    }
}

/// A sled on four feet at the corners of a rectangle, each with a quarter of the weight.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    define(
        corner[k in 0..4] = phi + pi * k / 2 + lean * cos(pi * k),
        px[k in 0..4] = x + r * cos(corner[k]),
        py[k in 0..4] = y + r * sin(corner[k]),
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    friction(foot[k in 0..4]: slip = (der(px[k]), der(py[k])), normal = mass * gravity / 4, static = mu),
)]
struct Sled {
    mass: f64,
    inertia: f64,
    r: f64,
    lean: f64,
    gravity: f64,
    mu: f64,
}

/// A foot that stops first holds, and takes the others with it only where they stop at the same instant: no speed is lost that friction has not
/// taken, and no force is told that a foot could not exert.
#[test]
fn a_sled_turns_about_the_foot_that_stops_first() {
    let sled = Sled {
        mass: 5.0,
        inertia: 0.2,
        r: 0.2,
        lean: 0.3,
        gravity: 9.81,
        mu: 0.28,
    };
    for (v, w) in [
        (1.337, 0.1),
        (0.11, 8.4),
        (0.92, 6.5),
        (2.0, 0.02),
        (1.0, 2.0),
    ] {
        let start = || state(&[0.0; 3], &[v, 0.3 * v, w]);
        let exact = run_by(&sled, ("taylor", 1e-12), start(), 5.0);
        for (method, tolerance) in methods_at(SINGLE_METHODS, [1e-6, 1e-9]) {
            let run = run_by(&sled, (method, tolerance), start(), 5.0);
            let asked = format!("{method} {tolerance:e} {v} {w}");
            let certificate = run.verify(0).expect("a certificate");
            assert!(certificate.holds(), "{asked}: {certificate}");
            let (q, expected) = (&run.final_state().q, &exact.final_state().q);
            all_agree(&asked, q, expected, 1e2 * tolerance);
        }
    }
}
