//! Bodies that touch and slide on side by side: nothing presses them together, and nothing tears them apart.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, words};

/// Two pucks on a rough table.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[2], y[2]),
    kinetic = sum(i in 0..2: mass/2 * (der(x[i])^2 + der(y[i])^2)),
    contact(touch: norm((x[1] - x[0], y[1] - y[0])) >= width),
    friction(cloth[i in 0..2]: slip = (der(x[i]), der(y[i])), normal = mass * 9.81, static = mu),
)]
struct Two {
    mass: f64,
    width: f64,
    mu: f64,
}

/// Three of them.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[3], y[3]),
    kinetic = sum(i in 0..3: mass/2 * (der(x[i])^2 + der(y[i])^2)),
    contact(first: norm((x[1] - x[0], y[1] - y[0])) >= width),
    contact(second: norm((x[2] - x[1], y[2] - y[1])) >= width),
    friction(cloth[i in 0..3]: slip = (der(x[i]), der(y[i])), normal = mass * 9.81, static = mu),
)]
struct Three {
    mass: f64,
    width: f64,
    mu: f64,
}

/// How far a puck goes with a speed, and which one it has after a distance.
fn slides(mu: f64, speed: f64) -> f64 {
    speed * speed / (2.0 * mu * 9.81)
}

fn slowed(mu: f64, speed: f64, distance: f64) -> f64 {
    (speed * speed - 2.0 * mu * 9.81 * distance).sqrt()
}

/// After a plastic impact both have half the speed and come to rest together.
#[test]
fn a_puck_pushes_another_along_and_stays_with_it() {
    for (mass, mu, speed) in [
        (0.17, 0.2, 2.0),
        (0.085, 0.16, 2.0),
        (0.17, 0.2, 1.4),
        (0.3, 0.1, 3.0),
    ] {
        let scene = Two {
            mass,
            width: 0.057,
            mu,
        };
        let gone = slides(mu, slowed(mu, speed, 0.243) / 2.0);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = state(&[-0.3, 0.0, 0.0, 0.0], &[speed, 0.0, 0.0, 0.0]);
            let motion = run_by(&scene, (method, tolerance), start, 3.0);
            let what = format!("{scene:?} {speed} by {method} at {tolerance:e}");
            agree(&what, motion.final_state().q[1], gone, 10.0 * tolerance);
            if method == Method::Auto {
                let expected = [
                    "touch impact",
                    "touch closed",
                    "cloth[1] slips",
                    "cloth[0] sticks",
                    "cloth[1] sticks",
                ];
                assert_eq!(words(&motion), expected, "{what}");
            }
            certified(&what, &motion);
        }
    }
}

/// Of three, two of which lie touching, all have a third of the speed.
#[test]
fn a_puck_pushes_two_along() {
    for speed in [1.0, 1.3, 1.5, 1.7, 2.0, 2.5] {
        let scene = Three {
            mass: 0.17,
            width: 0.057,
            mu: 0.2,
        };
        let gone = slides(0.2, slowed(0.2, speed, 0.243) / 3.0);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = state(
                &[-0.3, 0.0, 0.057, 0.0, 0.0, 0.0],
                &[speed, 0.0, 0.0, 0.0, 0.0, 0.0],
            );
            let motion = run_by(&scene, (method, tolerance), start, 3.0);
            let what = format!("{speed} by {method} at {tolerance:e}");
            for (j, expected) in [gone - 0.057, gone, gone + 0.057].into_iter().enumerate() {
                agree(&what, motion.final_state().q[j], expected, 10.0 * tolerance);
            }
            certified(&what, &motion);
        }
    }
}

/// Two bodies above a mat, with a spring between them that only pulls.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, z),
    kinetic = lower/2 * der(y)^2 + upper/2 * der(z)^2,
    potential = 9.81 * (lower * y + upper * z) + spring/2 * max(0, z - y - apart)^2,
    force(mat: y = if(y <= 0, max(0, -stiffness * y - damping * der(y)), 0)),
    dissipation(air: damping/20 * (der(y) - der(z))^2),
)]
struct Fallers {
    lower: f64,
    upper: f64,
    spring: f64,
    stiffness: f64,
    damping: f64,
    apart: f64,
}

/// The same with a stiffer spring, without the mat.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, z),
    kinetic = lower/2 * der(y)^2 + upper/2 * der(z)^2,
    potential = 9.81 * (lower * y + upper * z) + spring/2.2 * max(0, z - y - apart)^2.2,
)]
struct Hardening {
    lower: f64,
    upper: f64,
    spring: f64,
    apart: f64,
}

/// Bodies that fall side by side with a spring between them at its natural length: rounding decides on which side of it they are, and either side
/// will do.
#[test]
fn bodies_fall_at_the_length_of_a_spring() {
    let fall = |t: f64, h: f64, speed: f64| h + speed * t - 9.81 * t * t / 2.0;
    let fallers = Fallers {
        lower: 0.768_654_254_247_266_1,
        upper: 1.873_166_328_775_571_5,
        spring: 147.828_695_878_630_72,
        stiffness: 1_249.938_804_552_568_4,
        damping: 9.142_301_851_618_694,
        apart: 0.3,
    };
    let (h, t) = (0.852_048_027_693_799_3, 0.415);
    for pair in methods_at(METHODS, TOLERANCES) {
        let run = run_by(&fallers, pair, state(&[h, h + 0.3], &[0.0; 2]), t);
        certified(format!("{pair:?}"), &run);
        for (x, higher) in run.final_state().q.iter().zip([0.0, 0.3]) {
            let what = format!("height by {pair:?}");
            agree(what, *x, fall(t, h, 0.0) + higher, 10.0 * pair.1);
        }
    }
    let mut random = Random::new(64);
    for _ in 0..8 {
        let [lower, upper, spring] =
            [(0.3, 3.0), (0.3, 3.0), (20.0, 2e3)].map(|(low, high)| random.between(low, high));
        let [h, apart, speed] =
            [(0.5, 3.0), (0.1, 0.9), (-2.0, 2.0)].map(|(low, high)| random.between(low, high));
        let hardening = Hardening {
            lower,
            upper,
            spring,
            apart,
        };
        for method in METHODS {
            let start = state(&[h, h + apart], &[speed; 2]);
            let run = run_by(&hardening, (method, 1e-9), start, 0.6);
            certified(format!("{method:?} {hardening:?}"), &run);
            for (x, higher) in run.final_state().q.iter().zip([0.0, apart]) {
                agree("height", *x, fall(0.6, h, speed) + higher, 1e-8);
            }
        }
    }
}
