//! What is mirrored moves alike: where errors set equal events apart, the motion is still that of one part with the inertia of all.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, methods_at, run_by};

const METHODS: [&str; 6] = [
    "taylor",
    "dop853",
    "dopri5",
    "verner98",
    "radau5",
    "gauss6:1e-3",
];

/// A weight carried by two mirrored cranks with dry bearings; a hand moves it up and down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, a[2]),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * (der(a[0])^2 + der(a[1])^2),
    potential(weight: mass * 9.81 * y),
    potential(springs: stiffness/2 * ((a[0] - 0.3)^2 + (a[1] - 0.3)^2) + guide/2 * x^2),
    constraint(link[i in 0..2]: (x - (2*i - 1) * (base + crank * cos(a[i])))^2 + (y + crank * sin(a[i]))^2 == rod^2),
    friction(bearing[i in 0..2]: slip = der(a[i]), limit = dry),
    force(hand: push * sin(rate * t) along der(y)),
)]
struct Press {
    mass: f64,
    inertia: f64,
    stiffness: f64,
    guide: f64,
    base: f64,
    crank: f64,
    rod: f64,
    dry: f64,
    push: f64,
    rate: f64,
}

/// Half of it: the weight does not leave the middle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y, a),
    kinetic = mass/2 * der(y)^2 + inertia * der(a)^2,
    potential = mass * 9.81 * y + stiffness * (a - 0.3)^2,
    constraint(link: (base + crank * cos(a))^2 + (y + crank * sin(a))^2 == rod^2),
    friction(bearing: slip = der(a), limit = 2 * dry),
    force(hand: push * sin(rate * t) along der(y)),
)]
struct HalfPress {
    mass: f64,
    inertia: f64,
    stiffness: f64,
    base: f64,
    crank: f64,
    rod: f64,
    dry: f64,
    push: f64,
    rate: f64,
}

/// Rigid friction with given forces always has one motion (Moreau 1966).
#[test]
fn two_mirrored_cranks_move_as_one() {
    for k in 0..8 {
        let scene = Press {
            mass: 0.5 + 0.05 * f64::from(k),
            inertia: 0.05,
            stiffness: 7.0 - 0.2 * f64::from(k),
            guide: 60.0,
            base: 0.09,
            crank: 0.38,
            rod: 0.42,
            dry: 0.034,
            push: 3.7,
            rate: 2.9,
        };
        let half = HalfPress {
            mass: scene.mass,
            inertia: scene.inertia,
            stiffness: scene.stiffness,
            base: scene.base,
            crank: scene.crank,
            rod: scene.rod,
            dry: scene.dry,
            push: scene.push,
            rate: scene.rate,
        };
        let angle = 0.65_f64;
        let across = scene.base + scene.crank * angle.cos();
        let height =
            -scene.crank * angle.sin() - (scene.rod.powi(2) - across.powi(2)).max(0.0).sqrt();
        let start = state(&[height, angle], &[0.0; 2]);
        let exact = run_by(&half, ("taylor", 1e-12), start, 3.0);
        for (method, tolerance) in methods_at(METHODS, [1e-5, 1e-6, 1e-9]) {
            let start = state(&[0.0, height, angle, angle], &[0.0; 4]);
            let run = run_by(&scene, (method, tolerance), start, 3.0);
            let asked = format!("{method} {tolerance:e}, {k}");
            let end = run.final_state();
            let close = 1e2 * tolerance;
            agree(&asked, end.q(Press::X), 0.0, close);
            let height = exact.final_state().q(HalfPress::Y);
            agree(&asked, end.q(Press::Y), height, close);
        }
    }
}

/// A delta robot lets its platform hang on three arms; what the rods press makes the shoulders rub.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a[3], p[3]),
    define(
        reach[k in 0..3] = base + arm * cos(a[k]),
        knee[k in 0..3] = [reach[k] * cos(2*pi/3 * k), reach[k] * sin(2*pi/3 * k), -arm * sin(a[k])],
    ),
    kinetic = mass/2 * dot(der(p), der(p)) + sum(k in 0..3: inertia/2 * der(a[k])^2),
    potential = mass * 9.81 * p[2] + sum(k in 0..3: stiffness/2 * a[k]^2),
    constraint(link[k in 0..3]: dot(p - knee[k], p - knee[k]) / (2 * rod) == rod / 2),
    friction(shoulder[k in 0..3] on link[k]: slip = journal * der(a[k]), static = mu),
)]
struct Delta {
    mass: f64,
    inertia: f64,
    arm: f64,
    rod: f64,
    base: f64,
    stiffness: f64,
    journal: f64,
    mu: f64,
}

/// One arm with the inertia of three.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, z),
    kinetic = mass/2 * der(z)^2 + 3 * inertia/2 * der(a)^2,
    potential = mass * 9.81 * z + 3 * stiffness/2 * a^2,
    constraint(link: ((base + arm * cos(a))^2 + (z + arm * sin(a))^2) / (2 * rod) == rod / 2),
    friction(shoulder on link: slip = journal * der(a), static = mu),
)]
struct Arm {
    mass: f64,
    inertia: f64,
    arm: f64,
    rod: f64,
    base: f64,
    stiffness: f64,
    journal: f64,
    mu: f64,
}

/// The thrusts of three rods turn from push to pull at once, and three slips reverse.
#[test]
fn three_equal_arms_move_as_one() {
    for (mass, stiffness, journal) in [
        (0.41, 16.2, 0.116),
        (0.4088, 16.19, 0.1161),
        (1.044, 18.38, 0.04811),
    ] {
        let scene = Delta {
            mass,
            inertia: 0.02,
            arm: 0.2,
            rod: 0.5,
            base: 0.1,
            stiffness,
            journal,
            mu: 0.3,
        };
        let one = Arm {
            mass,
            inertia: 0.02,
            arm: 0.2,
            rod: 0.5,
            base: 0.1,
            stiffness,
            journal,
            mu: 0.3,
        };
        let angle = 0.5_f64;
        let across = 0.1 + 0.2 * angle.cos();
        let height = -0.2 * angle.sin() - (0.25 - across * across).sqrt();
        let exact = run_by(
            &one,
            ("taylor", 1e-12),
            state(&[angle, height], &[0.0; 2]),
            5.0,
        );
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let start = state(&[angle, angle, angle, 0.0, 0.0, height], &[0.0; 6]);
            let run = run_by(&scene, (method, tolerance), start, 5.0);
            let asked = format!("{method} {tolerance:e}, {mass} kg");
            let end = run.final_state();
            let close = 1e3 * tolerance;
            agree(&asked, end.q(Delta::P[0]), 0.0, close);
            agree(
                &asked,
                end.q(Delta::P[2]),
                exact.final_state().q(Arm::Z),
                close,
            );
        }
    }
}
