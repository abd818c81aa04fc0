//! A slinky that is let go: its turns fall onto each other from the top, without bouncing. While two of them collide others lie so near that
//! nothing but rounding is between.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, agree, certified, methods_at, run_by};

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y[6]),
    kinetic = sum(i in 0..6: mass/2 * der(y[i])^2),
    potential = sum(i in 0..6: mass * gravity * y[i]) + sum(i in 0..5: stiffness/2 * (y[i] - y[i+1])^2),
    contact(turn[i in 0..5]: y[i] - y[i+1] >= width),
)]
struct Slinky {
    mass: f64,
    stiffness: f64,
    gravity: f64,
    width: f64,
}

/// Hanging at rest: spring k carries all that is below it.
fn hanging(slinky: &Slinky) -> State<f64> {
    let mut y = [0.0; 6];
    for i in 1..6 {
        let below = (6 - i) as f64 * slinky.mass;
        y[i] = y[i - 1] - below * slinky.gravity / slinky.stiffness;
    }
    state(&y, &[0.0; 6])
}

/// The centre of mass falls freely, the lowest turn waits for the others (Cross & Wheatland 2012), and impacts without restitution leave one body.
#[test]
fn a_slinky_collapses_from_the_top() {
    let mut random = Random::new(9);
    for _ in 0..8 {
        let slinky = Slinky {
            mass: random.between(0.02, 0.1),
            stiffness: random.between(3.0, 9.0),
            gravity: random.between(7.0, 18.0),
            width: random.between(0.002, 0.01),
        };
        let start = hanging(&slinky);
        let centre = |q: &[f64]| q.iter().sum::<f64>() / 6.0;
        let (drop, first) = (centre(&start.q), start.q[5]);
        // Closed, it is 2.5 widths from its centre to its end: that long it falls before the end has been reached.
        let time = (2.0 * (drop - first) / slinky.gravity).sqrt();
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let by = (method, tolerance);
            let trajectory = run_by(&slinky, by, start.clone(), 1.5 * time);
            let end = trajectory.final_state();
            let fallen = slinky.gravity * (1.5 * time).powi(2) / 2.0;
            agree("centre", centre(&end.q), drop - fallen, 100.0 * tolerance);
            let closed = trajectory.final_mode().contacts.iter();
            assert_eq!(
                closed.filter(|closed| **closed).count(),
                5,
                "{method} {slinky:?}"
            );
            agree(
                "speed",
                end.v[0],
                -slinky.gravity * 1.5 * time,
                100.0 * tolerance,
            );
            agree("one body", end.v[5], end.v[0], 1e-12);
            let early = trajectory
                .sampler()
                .at(0.2 * time)
                .expect("an instant of the run");
            assert!((early.q(Slinky::Y[5]) - first).abs() < 1e-3 * (drop - first));
            certified(format!("{method} {tolerance:e} {slinky:?}"), &trajectory);
        }
    }
}
