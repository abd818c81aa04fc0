//! Guards that bend far more than the motion: every method finds the same events, however long its steps could be.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{TOLERANCES, agree, event, methods_at, root, run_by, words};

const METHODS: [&str; 7] = [
    "taylor",
    "dop853",
    "dopri5",
    "verner98",
    "radau5",
    "rk4:0.01",
    "gauss6:0.01",
];

/// A stone thrown over corrugated ground y = a sin kx; the motion is a polynomial, of which any method makes one step.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(ground: y >= height * sin(wave * x), restitution = 1/2),
    mark(crest: cos(wave * x)),
    stop(far: sqrt(x^2 + (y + 1)^2) >= reach),
)]
struct Corrugated {
    mass: f64,
    gravity: f64,
    height: f64,
    wave: f64,
    reach: f64,
}

const GROUND: Corrugated = Corrugated {
    mass: 1.0,
    gravity: 10.0,
    height: 0.04,
    wave: 70.0,
    reach: 9.0,
};

#[test]
fn all_methods_find_the_first_crossing_of_a_guard_that_oscillates() {
    // x = 3 t, y = 1 − 5 t²: with the ground's slope larger than the path's, the first of several roots is the impact.
    let gap = |t: f64| 1.0 - 5.0 * t * t - 0.04 * (70.0 * 3.0 * t).sin();
    let steps = (0..).map(|k| 1e-4 * f64::from(k));
    let first = steps
        .take(6000)
        .find(|t| gap(t + 1e-4) < 0.0)
        .expect("it comes down");
    let falls = root(gap, first, first + 1e-4);
    let crests = (70.0 * 3.0 * falls / core::f64::consts::PI + 0.5) as usize;
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let start = state(&[0.0, 1.0], &[3.0, 0.0]);
        let motion = run_by(&GROUND, (method, tolerance), start, falls + 1e-3);
        let asked = format!("{method} {tolerance:e}");
        let impact = event(&motion, "ground", "impact");
        agree(&asked, impact.time, falls, tolerance);
        let [x, y] = impact.state.q[..] else {
            panic!("two coordinates");
        };
        agree(&asked, y, 0.04 * (70.0 * x).sin(), tolerance);
        let events = motion.events().iter();
        let passed = events.filter(|e| e.kind.word() == "mark" && e.time < falls);
        let marks: Vec<f64> = passed.map(|e| e.time).collect();
        assert_eq!(marks.len(), crests, "{asked}: {:?}", words(&motion));
        for (k, time) in marks.iter().enumerate() {
            let crest = (k as f64 + 0.5) * core::f64::consts::PI / 210.0;
            agree(&asked, *time, crest, tolerance);
        }
    }
}

#[test]
fn all_methods_stop_where_the_condition_becomes_true() {
    let high = Corrugated {
        reach: 2.25,
        height: 0.0,
        ..GROUND
    };
    let distance = |t: f64| (3.0 * t).hypot(2.0 + 2.0 * t - 5.0 * t * t) - 2.25;
    let reaches = root(distance, 0.0, 0.25);
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let start = state(&[0.0, 1.0], &[3.0, 2.0]);
        let motion = run_by(&high, (method, tolerance), start, 5.0);
        agree(
            format!("{method} {tolerance:e}"),
            event(&motion, "far", "stop").time,
            reaches,
            tolerance,
        );
    }
}

/// A bead that slides through the middle of its string: |x| has a kink there, and 1 − |x| ends the slide on the other side.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, phi),
    kinetic = der(x)^2/2 + der(phi)^2/2,
    contact(knot: 1 >= sqrt(x^2), restitution = 1),
    mark(never: atan2(sin(phi), -cos(phi)) - 3.2),
)]
struct Beads {
    unused: f64,
}

#[test]
fn all_methods_pass_kinks_and_cuts() {
    let scene = Beads { unused: 0.0 };
    for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-12]) {
        let start = state(&[0.3, 0.2], &[-0.8, 5.0]);
        let motion = run_by(&scene, (method, tolerance), start, 4.5);
        let asked = format!("{method} {tolerance:e}");
        assert_eq!(words(&motion), ["knot impact", "knot impact"], "{asked}");
        agree(&asked, motion.events()[0].time, 1.3 / 0.8, tolerance);
        agree(&asked, motion.events()[1].time, 3.3 / 0.8, tolerance);
    }
}

/// A bead flies straight past a round post, by a thousandth of what its samples are away from it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    contact(post: sqrt(x^2 + y^2) >= radius, restitution = 1),
    stop(seen: sqrt(x^2 + (y - 3)^2) <= 3 - sight),
)]
struct Passing {
    radius: f64,
    sight: f64,
}

#[test]
fn what_passes_close_by_does_not_strike() {
    let scene = |sight| Passing { radius: 1.0, sight };
    for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
        let asked = format!("{method} {tolerance:e}");
        for distance in [1e-5, 1e-7, 1e-8] {
            let start = state(&[-1.0, 1.0 + distance], &[1.0, 0.0]);
            // The stop is as far away as the post.
            let passes = run_by(
                &scene(1.0 + 2.0 * distance),
                (method, tolerance),
                start,
                2.0,
            );
            assert!(passes.events().is_empty(), "{asked}: {:?}", words(&passes));
        }
    }
}
