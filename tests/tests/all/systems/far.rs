//! Far from where coordinates are counted from, and fast: a gap is the small difference of large numbers, and rounding of it is that of these.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, methods_at, run_by, words};

/// Two bodies on a spring, with a bumper that rubs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[2], y[2]),
    kinetic = sum(k in 0..2: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = stiffness/2 * ((x[1] - x[0])^2 + (y[1] - y[0])^2),
    contact(bumper: x[1] - x[0] >= width, restitution = bounce),
    friction(rub on bumper: slip = der(y[1]) - der(y[0]), static = mu),
    mark(turn: der(x[1]) - der(x[0])),
    mark(near: x[1] - x[0] - 2 * width),
)]
struct Bodies {
    mass: [f64; 2],
    stiffness: f64,
    width: f64,
    bounce: f64,
    mu: f64,
}

/// Nothing that happens depends on where the bodies are and how fast they move together (Galilei), but for rounding: 2⁻⁵³ of 1e7 m, at some m/s.
#[test]
fn bodies_meet_where_they_would_at_home() {
    let bodies = Bodies {
        mass: [10.0, 20.0],
        stiffness: 30.0,
        width: 1.0,
        bounce: 0.3,
        mu: 0.2,
    };
    let begin = |[place, speed]: [f64; 2]| {
        state(
            &[place, place + 5.0, place, place],
            &[speed + 2.0, speed, speed, speed + 0.6],
        )
    };
    let home = run_by(&bodies, ("taylor", 1e-12), begin([0.0, 0.0]), 6.0);
    assert!(
        home.events()
            .iter()
            .any(|event| event.kind == EventKind::Closed)
    );
    for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
        let far = run_by(&bodies, (method, tolerance), begin([1e7, 7e3]), 6.0);
        let impacts = |run: &Trajectory| -> Vec<f64> {
            let impacts = run
                .events()
                .iter()
                .filter(|event| event.kind == EventKind::Impact);
            impacts.map(|event| event.time).take(4).collect()
        };
        for (far, home) in impacts(&far).into_iter().zip(impacts(&home)) {
            agree("impact", far, home, 1e3 * tolerance + 1e-8);
        }
        assert!(
            words(&far).contains(&"bumper closed".into()),
            "{method} {:?}",
            words(&far)
        );
        certified(format!("{method} {tolerance:e}"), &far);
    }
}

/// Two satellites on a rope, in coordinates from the centre of the Earth.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[2], y[2]),
    define(r[k in 0..2] = norm([x[k], y[k]])),
    kinetic = sum(k in 0..2: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..2: -earth * mass[k] / r[k]),
    contact(rope: norm([x[1] - x[0], y[1] - y[0]]) <= length, restitution = bounce),
    observe(moment = sum(k in 0..2: mass[k] * (x[k] * der(y[k]) - y[k] * der(x[k])))),
)]
struct Satellites {
    earth: f64,
    mass: [f64; 2],
    length: f64,
    bounce: f64,
}

/// They bounce on their rope until it stays taut, however tight the tolerance. The moment of momentum is kept.
#[test]
fn a_rope_in_orbit_becomes_taut() {
    let pair = Satellites {
        earth: 3.986e14,
        mass: [1000.0, 200.0],
        length: 1000.0,
        bounce: 0.5,
    };
    let (radius, apart) = (6.8e6, 500.0);
    let speed = (pair.earth / radius).sqrt();
    for (method, tolerance) in methods_at(METHODS, [1e-9, 1e-12]) {
        let start = state(
            &[radius, radius + apart, 0.0, 0.0],
            &[0.0, 1.5, speed, speed],
        );
        let trajectory = run_by(&pair, (method, tolerance), start, 4000.0);
        assert!(
            words(&trajectory).ends_with(&["rope closed".into()]),
            "{method} {tolerance:e}"
        );
        let mut sampler = trajectory.sampler();
        let mut moment = |t| {
            sampler
                .at(t)
                .expect("an instant of the run")
                .observe(Satellites::MOMENT)
        };
        agree(
            "moment",
            moment(4000.0) / moment(0.0),
            1.0,
            100.0 * tolerance,
        );
        certified(format!("{method} {tolerance:e}"), &trajectory);
    }
}
