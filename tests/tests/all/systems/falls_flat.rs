//! A crate that falls flat onto a rough floor and bounces: it stays flat, although its two edges are hit by impulses of their own.

use super::state;
use lagrange_core::integrate::Method;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, run_by};

/// The middle of the lower side is at (x, y − lower).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    define(
        left = [x - half * cos(phi) + lower * sin(phi), y - half * sin(phi) - lower * cos(phi)],
        right = [x + half * cos(phi) + lower * sin(phi), y + half * sin(phi) - lower * cos(phi)],
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(rear: left[1] >= 0, restitution = e),
    contact(front: right[1] >= 0, restitution = e),
    friction(rear_grip on rear: slip = der(left[0]), static = mu),
    friction(front_grip on front: slip = der(right[0]), static = mu),
)]
struct Crate {
    mass: f64,
    inertia: f64,
    half: f64,
    lower: f64,
    gravity: f64,
    e: f64,
    mu: f64,
}

#[test]
fn what_falls_flat_stays_flat() {
    let mut random = Random::new(61);
    for _ in 0..12 {
        let scene = Crate {
            mass: random.between(0.4, 3.0),
            inertia: random.between(0.02, 0.2),
            half: random.between(0.3, 0.8),
            lower: random.between(0.01, 0.05),
            gravity: random.between(3.0, 12.0),
            e: random.between(0.3, 0.7),
            mu: random.between(0.05, 0.3),
        };
        let (height, speed) = (random.between(0.3, 1.5), random.between(2.0, 6.0));
        let start = state(&[0.0, scene.lower + height, 0.0], &[speed, 0.0, 0.0]);
        let fall = (2.0 * height / scene.gravity).sqrt();
        for method in [Method::Taylor, Method::DormandPrince853, Method::Verner98] {
            bounces(&scene, &start, fall, method);
        }
    }
}

/// Five bounces: each takes the time 2 eᵏ t of its flight, and μ (1 + e) eᵏ g t of the speed.
#[track_caller]
fn bounces(scene: &Crate, start: &State<f64>, fall: f64, method: Method) {
    const BOUNCES: usize = 5;
    let flights: f64 = (1..BOUNCES).map(|k| 2.0 * scene.e.powi(k as i32)).sum();
    let end = (1.0 + flights + scene.e.powi(BOUNCES as i32)) * fall;
    let simulation = Simulation::new(scene).method(method);
    let trajectory = simulation.run(start.clone(), 0.0..end).unwrap();
    let events = trajectory.events();
    assert_eq!(events.len(), 2 * BOUNCES, "{method:?} {scene:?}");
    let (mut time, mut speed) = (fall, start.v[0]);
    for (k, pair) in events.chunks_exact(2).enumerate() {
        let share = scene.e.powi(k as i32);
        speed -= scene.mu * (1.0 + scene.e) * share * scene.gravity * fall;
        speed = speed.max(0.0);
        for event in pair {
            assert_eq!(event.kind, EventKind::Impact);
            agree("time", event.time, time, 1e-11);
            agree("speed", event.state_after.v[0], speed, 1e-9);
            assert_eq!(event.state_after.v[2], 0.0);
        }
        time += 2.0 * scene.e * share * fall;
    }
    agree("x speed", trajectory.final_state().v[0], speed, 1e-9);
    assert_eq!(trajectory.final_state().q[2], 0.0);
}

/// A cupboard that stands with one side at a wall, tilted about its other lower corner, which is rough.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, p),
    define(
        c = cos(p),
        s = sin(p),
        left = [x - a*c + b*s, y - a*s - b*c],
        lower = [x + a*c + b*s, y + a*s - b*c],
        upper = x + a*c - b*s,
    ),
    kinetic = mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(p)^2,
    potential = mass*9.81*y,
    contact(heel: left[1] >= 0, restitution = 1/2),
    friction(grip on heel: slip = der(left[0]), static = 9/10),
    contact(toe: lower[1] >= 0, restitution = 1/2),
    contact(foot: lower[0] <= wall, restitution = 1/2),
    contact(shoulder: upper <= wall, restitution = 1/2),
    start(tilted: p = tilt, x = wall - 2*a + a*cos(tilt) - b*sin(tilt), y = a*sin(tilt) + b*cos(tilt)),
)]
struct Cupboard {
    mass: f64,
    inertia: f64,
    a: f64,
    b: f64,
    wall: f64,
    tilt: f64,
}

/// It falls back on its face, where its foot touches the wall without coming to it (the gap is 2a (1 − cos p)), until its bounces have died out.
#[test]
fn a_cupboard_falls_back_into_a_corner() {
    let mut random = Random::new(54);
    for _ in 0..12 {
        let (a, b) = (random.between(0.3, 0.6), random.between(0.3, 0.6));
        let mass = random.between(0.8, 2.0);
        let scene = Cupboard {
            mass,
            inertia: mass * (a * a + b * b) / 3.0,
            a,
            b,
            wall: 0.57,
            tilt: random.between(0.01, 0.08),
        };
        for (method, tolerance) in [("auto", 1e-6), ("auto", 1e-9), ("dop853", 1e-9)] {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let start = scene.at(Cupboard::TILTED);
            let motion = run_by(&scene, (method, tolerance), start, 2.0);
            let end = motion.final_state();
            agree(&what, end.q[2], 0.0, tolerance);
            agree(&what, end.q[1], b, tolerance);
            agree(&what, end.v[2], 0.0, tolerance);
            assert!(motion.final_mode().closed(Cupboard::HEEL), "{what}");
            assert!(motion.final_mode().closed(Cupboard::TOE), "{what}");
        }
    }
}
