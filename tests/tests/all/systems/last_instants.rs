//! What happens with the very end of a run has happened, by all methods; what would happen just after it has not.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, certified, run_by, words};

const METHODS: [&str; 7] = [
    "taylor",
    "dop853",
    "dopri5",
    "verner98",
    "radau5",
    "rk4:1e-2",
    "gauss6:1e-2",
];

/// Runs a scene until `last`, by when one thing happens, and until just before.
fn happens_last(scene: &impl System<Scalar = f64>, start: State<f64>, last: f64, told: &str) {
    for method in METHODS {
        let what = format!("{method} until {last}");
        let run = run_by(scene, (method, 1e-12), start.clone(), last);
        assert_eq!(words(&run), [told], "{what}");
        agree(&what, run.events()[0].time, last, 1e-11);
        assert_eq!(run.last_time(), last, "{what}");
        certified(&what, &run);
        let shorter = run_by(scene, (method, 1e-12), start.clone(), last * (1.0 - 1e-9));
        assert_eq!(words(&shorter), [""; 0], "{what}, shorter");
    }
}

/// A bead between two walls.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = mass * pull * x,
    contact(wall: x >= 0, restitution = 0.7),
)]
struct Bead {
    mass: f64,
    pull: f64,
}

#[test]
fn impacts() {
    let mut random = Random::new(3);
    for _ in 0..10 {
        let [mass, pull, from] = [0.1, 0.5, 0.2].map(|least| random.between(least, 4.0));
        let last = (2.0 * from / pull).sqrt();
        let start = state(&[from], &[0.0]);
        happens_last(&Bead { mass, pull }, start, last, "wall impact");
    }
}

/// A sledge on rough ground, which is pushed more and more.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    friction(ground: slip = der(x), normal = mass * gravity, static = mu),
    force(push: x = rate * t),
)]
struct Sledge {
    mass: f64,
    gravity: f64,
    mu: f64,
    rate: f64,
}

#[test]
fn sticking_and_slipping() {
    let mut random = Random::new(4);
    for _ in 0..10 {
        let [mass, gravity, mu] = [0.3, 1.0, 0.1].map(|least| random.between(least, 2.0));
        let speed = random.between(0.2, 3.0);
        let brakes = Sledge {
            mass,
            gravity,
            mu,
            rate: 0.0,
        };
        let start = state(&[0.0], &[speed]);
        happens_last(&brakes, start, speed / (mu * gravity), "ground sticks");
        let last = random.between(0.5, 3.0);
        let pushed = Sledge {
            rate: mu * mass * gravity / last,
            ..brakes
        };
        happens_last(&pushed, state(&[0.0], &[0.0]), last, "ground slips");
    }
}

/// A crate on a table that ends, lifted more and more.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(table: y >= 0, where x <= length),
    force(lift: y = rate * t),
)]
struct Crate {
    mass: f64,
    gravity: f64,
    length: f64,
    rate: f64,
}

#[test]
fn contacts_are_lost_and_surfaces_end() {
    let mut random = Random::new(5);
    for _ in 0..10 {
        let [mass, gravity, speed] = [0.3, 1.0, 0.2].map(|least| random.between(least, 3.0));
        let last = random.between(0.5, 3.0);
        let lifted = Crate {
            mass,
            gravity,
            length: 10.0,
            rate: mass * gravity / last,
        };
        let start = state(&[0.0, 0.0], &[speed, 0.0]);
        happens_last(&lifted, start.clone(), last, "table lost");
        let slides = Crate {
            length: speed * last,
            rate: 0.0,
            ..lifted
        };
        happens_last(&slides, start, last, "table lost");
    }
}

/// A mass that runs onto a spring.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = stiffness/2 * max(x - length, 0)^2,
)]
struct Buffer {
    mass: f64,
    stiffness: f64,
    length: f64,
}

#[test]
fn branches() {
    let mut random = Random::new(6);
    for _ in 0..10 {
        let [mass, stiffness, length] = [0.3, 1.0, 0.2].map(|least| random.between(least, 3.0));
        let scene = Buffer {
            mass,
            stiffness,
            length,
        };
        let speed = random.between(0.3, 3.0);
        let run = run_by(
            &scene,
            ("taylor", 1e-12),
            state(&[0.0], &[speed]),
            2.0 * length / speed,
        );
        let told = &words(&run)[0];
        happens_last(&scene, state(&[0.0], &[speed]), length / speed, told);
    }
}
