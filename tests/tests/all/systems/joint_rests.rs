//! Slips of one motion that end at one instant, whatever the errors of the run say of each.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, event, methods_at, run, run_by};

/// A bob on a rod rubs along two walls and is pushed ever more.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    constraint(rod: sqrt(x^2 + y^2) == 1),
    friction(floor: slip = der(x), limit = (a, 4/5 * a)),
    friction(wall: slip = der(y), limit = (b, 4/5 * b)),
    force(push: x = rise * t^2),
)]
struct Bob {
    a: f64,
    b: f64,
    rise: f64,
}

/// Both slips end together, and begin again where the push along the circle exceeds what both hold: (a |cos φ| + b |sin φ|).
#[test]
fn frictions_that_come_to_rest_together_hold_together() {
    let mut random = Random::new(45);
    let mut rested = 0;
    for _ in 0..12 {
        let bob = Bob {
            a: random.between(0.8, 2.0),
            b: random.between(0.8, 2.0),
            rise: random.between(1.0, 1.6),
        };
        let speed = -random.between(1.2, 1.7);
        let (sin, cos) = random.between(0.02, 0.3).sin_cos();
        let start = state(&[sin, -cos], &[speed * cos, speed * sin]);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&bob, (method, tolerance), start.clone(), 3.0);
            let sticks = motion.events().iter().find(|event| {
                event.kind == EventKind::Sticks && event.subject == Subject::Friction(1)
            });
            let Some(rest) = sticks else {
                continue;
            };
            rested += 1;
            let what = format!("{bob:?} {speed} by {method} at {tolerance:e}");
            agree(
                &what,
                event(&motion, "floor", "sticks").time,
                rest.time,
                1e-15,
            );
            let [x, y] = [0, 1].map(|j| rest.state_after.q[j].abs());
            let time = ((bob.a * y + bob.b * x) / (bob.rise * y)).sqrt();
            for friction in ["floor", "wall"] {
                let slips = event(&motion, friction, "slips").time;
                agree(&what, slips, time, 100.0 * tolerance);
            }
        }
    }
    assert!(rested > 100, "{rested} runs come to rest");
}

/// A block on a wedge that stands on a floor, in coordinates of which none is that of a surface. One of its three rows follows from the others: only the
/// numbers sin 1 and cos 1 hide it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, x, w),
    define(y = a + w),
    kinetic = der(w)^2/2 + (der(x)^2 + der(y)^2)/2,
    contact(face: y*cos(1) + (x - w)*sin(1) >= 0),
    friction(grip on face: slip = der(x) - der(w) - der(y), static = mu),
    dissipation(drag: der(w)^2/2),
    contact(floor: y >= 0),
)]
struct Wedge {
    mu: f64,
}

/// Both move as one: 2 ẅ = −ẇ.
#[test]
fn a_row_that_follows_from_others_in_sines_is_no_divisor() {
    let start = state(&[0.0; 3], &[1.0, -1.0, -1.0]);
    let motion = run(&Wedge { mu: 1.0 }, start, 2.0);
    let gone = 2.0 * (1.0 - (-1.0_f64).exp());
    for (j, expected) in [gone, -gone, -gone].into_iter().enumerate() {
        agree("position", motion.final_state().q[j], expected, 1e-9);
    }
}

/// A crank moves two slides by cams that are in their dead centres at one instant, and both slides rub.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(q, x, y),
    kinetic = (der(q)^2 + der(x)^2 + der(y)^2) / 2,
    constraint(first: x == cos(a*q)),
    constraint(second: y == c*cos(b*q)),
    friction(on_first: slip = der(x), limit = f),
    friction(on_second: slip = der(y), limit = g),
    start(turning: q = -q0, x = cos(a*q0), y = c*cos(b*q0), der(q) = w, der(x) = w*a*sin(a*q0), der(y) = w*b*c*sin(b*q0)),
)]
struct Cams {
    a: f64,
    b: f64,
    c: f64,
    f: f64,
    g: f64,
    q0: f64,
    w: f64,
}

/// No friction holds a slide there; what the crank loses is what the frictions take on the ways of the slides.
#[test]
fn frictions_that_are_in_their_dead_centres_together_do_not_hold() {
    let mut random = Random::new(47);
    for _ in 0..12 {
        let cams = Cams {
            a: random.between(0.6, 1.6),
            b: random.between(0.6, 1.6),
            c: random.between(0.6, 1.6),
            f: random.between(0.1, 0.4),
            g: random.between(0.1, 0.4),
            q0: random.between(0.05, 0.6),
            w: random.between(1.5, 3.0),
        };
        let energy = |q: f64, w: f64| {
            let slides = [(cams.a, 1.0), (cams.b, cams.c)];
            let rates = slides.map(|(turns, size)| turns * size * (turns * q).sin());
            (1.0 + rates[0].powi(2) + rates[1].powi(2)) * w * w / 2.0
        };
        // Both slides go out to where they turn, and back.
        let taken = |q: f64| {
            let way = |turns: f64| 2.0 - (turns * cams.q0).cos() - (turns * q).cos();
            cams.f * way(cams.a) + cams.g * cams.c * way(cams.b)
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{cams:?} by {method} at {tolerance:e}");
            let motion = run_by(&cams, (method, tolerance), cams.at(Cams::TURNING), 0.7);
            let end = motion.final_state();
            assert!(end.q[0] > 0.0, "{what}: {}", end.q[0]);
            let lost = energy(cams.q0, cams.w) - energy(end.q[0], end.v[0]);
            agree(&what, lost, taken(end.q[0]), 100.0 * tolerance);
        }
    }
}
