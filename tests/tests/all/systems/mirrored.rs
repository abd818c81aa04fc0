//! What is mirrored moves alike: what rounding sets apart happens at once.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, run_by, words};

const METHODS: [&str; 6] = [
    "taylor",
    "dop853",
    "dopri5",
    "verner98",
    "radau5",
    "gauss6:5e-4",
];

/// Two balls bounce on the ends of a plank that springs carry.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, theta, a, b),
    kinetic = plank/2 * der(y)^2 + plank * half^2 / 6 * der(theta)^2 + ball/2 * (der(a)^2 + der(b)^2),
    potential = gravity * (plank * y + ball * (a + b)) + stiffness/2 * y^2 + hinge/2 * theta^2,
    contact(left: a >= y - half * sin(theta), restitution = bounce),
    contact(right: b >= y + half * sin(theta), restitution = bounce),
)]
struct Plank {
    plank: f64,
    ball: f64,
    half: f64,
    gravity: f64,
    stiffness: f64,
    hinge: f64,
    bounce: f64,
}

/// The plank does not tilt, and one ball of the mass of both on half a plank's width moves as each of them.
#[test]
fn mirrored_blows_fall_together() {
    let scene = Plank {
        plank: 3.0,
        ball: 1.0,
        half: 1.0,
        gravity: 9.81,
        stiffness: 60.0,
        hinge: 40.0,
        bounce: 0.5,
    };
    for (method, tolerance) in METHODS
        .into_iter()
        .flat_map(|m| [(m, 1e-6), (m, 1e-9), (m, 1e-12)])
    {
        let start = state(&[0.0, 0.0, 0.4, 0.4], &[0.0; 4]);
        let run = run_by(&scene, (method, tolerance), start, 2.6);
        let asked = format!("{method} {tolerance:e}");
        let times = |side: &str| -> Vec<f64> {
            let d = run.description();
            let events = run.events().iter().filter(|e| e.subject.name(d) == side);
            events.map(|e| e.time).collect()
        };
        assert!(times("left").len() > 20, "{asked}");
        assert_eq!(times("left"), times("right"), "{asked}");
        agree(&asked, run.final_state().q(Plank::THETA), 0.0, 1e-13);
    }
}

/// A weight carried by two mirrored cranks with dry bearings; a hand moves it up and down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
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

/// Rigid friction with given forces always has one motion (Moreau 1966), here without any towards a side.
#[test]
fn mirrored_frictions_reverse_together() {
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
        let angle = 0.65_f64;
        let across = scene.base + scene.crank * angle.cos();
        let height =
            -scene.crank * angle.sin() - (scene.rod.powi(2) - across.powi(2)).max(0.0).sqrt();
        for (method, tolerance) in METHODS
            .into_iter()
            .flat_map(|m| [(m, 1e-5), (m, 1e-6), (m, 1e-9)])
        {
            let start = state(&[0.0, height, angle, angle], &[0.0; 4]);
            let run = run_by(&scene, (method, tolerance), start, 3.0);
            let asked = format!("{method} {tolerance:e}, {k}");
            let times = |i: usize| -> Vec<f64> {
                let events = run.events().iter();
                let own = events.filter(|e| e.subject == Subject::Friction(i));
                own.map(|e| e.time).collect()
            };
            assert_eq!(times(0), times(1), "{asked}: {:?}", words(&run));
            agree(&asked, run.final_state().q(Press::X), 0.0, 1e-12);
        }
    }
}
