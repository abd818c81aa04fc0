//! Derivatives of the instants of events, dt/dp = −(∂g/∂p)/ġ, by every method and at every tolerance as exact as the instants are.

use super::{Slopes, run, same_slopes, seeded};
use lagrange_core::prelude::*;

/// A ball falls for a second.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = 0.5),
    start(held: y = height),
)]
struct Fall<T = f64> {
    gravity: T,
    height: T,
}

/// What happens at the last instant of a span moves with it, t = √(2h/g).
#[test]
fn the_instant_of_an_impact_at_the_end_of_a_run_moves() {
    for (height, until) in [(1.0, 1.0), (4.0, 2.0)] {
        let [gravity, height] = seeded([2.0, height]);
        let ball = Fall { gravity, height };
        let record = run(&ball, ball.at(<Fall>::HELD), until, (1e-9, Method::Auto));
        assert_eq!(record.last_time(), until);
        let [impact] = record.events() else {
            panic!("{record}");
        };
        let expected = (Slopes::constant(2.0) * height / gravity).sqrt();
        same_slopes("impact", impact.time, expected, 1e-12);
    }
}
