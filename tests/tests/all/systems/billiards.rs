//! Chaos between exact flights: straight lines are exact at all tolerances, and what makes runs differ is rounding alone.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::agree;

/// A ball without forces in a square with a disc in its middle (Sinai 1970).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    contact(left: x >= -1, restitution = 1),
    contact(right: x <= 1, restitution = 1),
    contact(low: y >= -1, restitution = 1),
    contact(high: y <= 1, restitution = 1),
    contact(disc: x^2 + y^2 >= radius^2, restitution = 1),
)]
struct Billiard {
    radius: f64,
}

const BILLIARD: Billiard = Billiard { radius: 0.4 };

fn within(error: f64, start: &State<f64>, until: f64) -> Result<Trajectory, Failure> {
    let simulation = Simulation::new(&BILLIARD).error(error);
    simulation.run(start.clone(), 0.0..until)
}

/// Two runs that round in the same way are no evidence.
#[test]
fn what_rounding_leaves_open_is_not_promised() {
    let start = state(&[-0.695, 0.801], &[0.98, -0.97]);
    for error in [1e-4, 1e-6, 1e-8, 1e-11] {
        let failure = within(error, &start, 35.0).expect_err("46 impacts");
        let Error::Inexact { asked, .. } = failure.error else {
            panic!("{failure}");
        };
        assert_eq!(asked, error);
    }
    assert!(within(1e-8, &start, 6.0).is_ok());
}

/// The same without the disc: a coordinate goes to and fro by itself, which is no chaos.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    contact(left: x >= -wide, restitution = 1),
    contact(right: x <= wide, restitution = 1),
    contact(low: y >= -wide, restitution = 1),
    contact(high: y <= wide, restitution = 1),
)]
struct Walls {
    wide: f64,
}

#[test]
fn what_rounding_leaves_as_it_is_can_be_had() {
    let walls = Walls { wide: 1.0 };
    let until = 30.0;
    for (x, u, v) in [
        (0.37, 0.713, 0.531),
        (-0.2, 0.91, -0.37),
        (0.8, -0.45, 0.66),
    ] {
        let run = Simulation::new(&walls)
            .error(1e-11)
            .run(state(&[x, 0.0], &[u, v]), 0.0..until)
            .unwrap_or_else(|failure| panic!("{failure}"));
        let folded = |from: f64, speed: f64| {
            let along = (from + 1.0 + until * speed).rem_euclid(4.0);
            1.0 - (along - 2.0).abs()
        };
        let end = run.final_state();
        agree("x", end.q[0], folded(x, u), 1e-11);
        agree("y", end.q[1], folded(0.0, v), 1e-11);
    }
}
