//! Marks at quantities with corners and jumps: |sin θ|, acos(cos θ), the cut of `atan2`; and smooth ones at the same instants.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, times};

/// A rotor that turns evenly, or ever faster, marked at corners.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = der(theta)^2 / 2,
    force(motor: theta = faster),
    mark(far: acos(cos(theta)) >= 3),
    mark(chord: sqrt(1 - cos(theta)) <= share),
    mark(root: sqrt(sin(theta)^2) <= share),
    mark(size: abs(sin(theta)) <= share),
    mark(larger: max(sin(theta), -sin(theta)) <= share),
)]
struct Rotor {
    faster: f64,
    share: f64,
}

/// The same, marked where its angle jumps.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = der(theta)^2 / 2,
    force(motor: theta = faster),
    mark(cut: atan2(sin(theta), cos(theta)) <= -3),
    mark(smooth: sin(theta) <= 0),
)]
struct Compass {
    faster: f64,
}

/// Angles between 0 and 2π at which each mark becomes true as the rotor turns forward.
fn angles(mark: &str, share: f64) -> Vec<f64> {
    match mark {
        "far" => vec![3.0],
        "chord" => vec![2.0 * PI - (1.0 - share * share).acos()],
        "root" | "size" | "larger" => vec![PI - share.asin(), 2.0 * PI - share.asin()],
        _ => vec![PI],
    }
}

/// Whether a run from an angle at a rate passes each of these marks once where it should; `faster` is how much faster it turns.
fn passes_once(
    what: &str,
    run: &Trajectory,
    marks: &[&str],
    [faster, share, from, rate]: [f64; 4],
    tolerance: f64,
) {
    let until = run.last_time();
    let turned = rate * until + faster * until * until / 2.0;
    // θ − θ₀ = ω t + a t²/2, written so that it holds for a = 0 too.
    let when = |angle: f64| {
        let way = angle - from;
        2.0 * way / (rate + (rate * rate + 2.0 * faster * way).sqrt())
    };
    for mark in marks {
        let turns = (0..9).map(|k| 2.0 * PI * f64::from(k));
        let at = |turn: f64| {
            angles(mark, share)
                .into_iter()
                .map(move |angle| angle + turn)
        };
        let passed = turns
            .flat_map(at)
            .filter(|&angle| angle > from && angle < from + turned);
        let passed: Vec<f64> = passed.map(when).collect();
        let found = times(run, mark, "mark");
        assert_eq!(
            found.len(),
            passed.len(),
            "{what}: {mark} {found:?} {passed:?}"
        );
        for (found, passed) in found.into_iter().zip(passed) {
            agree(format!("{what}: {mark}"), found, passed, 300.0 * tolerance);
        }
    }
    certified(what, run);
}

#[test]
fn marks_at_corners_and_jumps_are_passed_once() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let mut random = Random::new(5);
        for case in 0..4 {
            let (faster, share) = ([0.0, 0.4][case % 2], random.between(0.02, 0.6));
            let (from, rate) = (random.between(0.7, 2.0), random.between(1.0, 4.0));
            let what = format!("{method} at {tolerance:e}, {case}");
            let start = || state(&[from], &[rate]);
            let numbers = [faster, share, from, rate];
            let rotor = run_by(&Rotor { faster, share }, (method, tolerance), start(), 8.0);
            let corners = ["far", "chord", "root", "size", "larger"];
            passes_once(&what, &rotor, &corners, numbers, tolerance);
            let compass = run_by(&Compass { faster }, (method, tolerance), start(), 8.0);
            passes_once(&what, &compass, &["cut", "smooth"], numbers, tolerance);
        }
    }
}

/// A rotor that is marked where a tangent, a cotangent or a fraction is large.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = der(theta)^2 / 2,
    mark(steep: tan(theta) >= 3),
    mark(flat: 1 / tan(theta) >= 3),
    mark(near: 1 / (theta - place) >= 2),
)]
struct Poles {
    place: f64,
}

/// Each mark becomes true at its pole, or before it; steps become short there, and long again behind it.
#[test]
fn marks_with_poles_are_passed() {
    let mut random = Random::new(566);
    for _ in 0..4 {
        let (from, place) = (random.between(-1.4, -0.5), random.between(0.2, 0.9));
        for pair in methods_at(METHODS, TOLERANCES) {
            let what = format!("{from} {place} by {pair:?}");
            let run = run_by(&Poles { place }, pair, state(&[from], &[1.0]), 5.0);
            assert!(
                run.work().steps < 3000,
                "{what}: {} steps",
                run.work().steps
            );
            for (mark, angle) in [("steep", 3.0_f64.atan()), ("flat", 0.0), ("near", place)] {
                agree(
                    format!("{what}: {mark}"),
                    times(&run, mark, "mark")[0],
                    angle - from,
                    1e-11,
                );
            }
        }
    }
}

/// Marks with corners beside one another, by the default method: each step ends at a corner of one of them, and may be far too long for the others.
#[test]
fn marks_before_what_ends_a_step_are_passed() {
    let mut random = Random::new(568);
    for case in 0..60 {
        let (faster, share) = ([0.0, 0.4][case % 2], random.between(0.02, 0.6));
        let (from, rate) = (random.between(0.7, 2.0), random.between(1.0, 4.0));
        for tolerance in TOLERANCES {
            let pair = ("auto", tolerance);
            let run = run_by(&Rotor { faster, share }, pair, state(&[from], &[rate]), 8.0);
            let what = format!("{case} at {tolerance:e}");
            let corners = ["far", "chord", "root", "size", "larger"];
            passes_once(
                &what,
                &run,
                &corners,
                [faster, share, from, rate],
                tolerance,
            );
        }
    }
}
