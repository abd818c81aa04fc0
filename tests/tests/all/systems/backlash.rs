//! Two gears with a play between their teeth: the gap is a small difference of large angles.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, event, run_by};

/// One gear is driven; the other is taken along once the play is used up.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, b),
    kinetic = driving/2 * der(a)^2 + driven/2 * der(b)^2,
    contact(tooth: b - a >= -play, restitution = e),
    force(drive: a = torque * cos(rate * t)),
)]
struct Gears {
    driving: f64,
    driven: f64,
    play: f64,
    torque: f64,
    rate: f64,
    e: f64,
}

const METHODS: [&str; 4] = ["auto", "dopri5", "dop853", "verner98"];

/// Whatever the blows are, the momentum is the impulse of the drive, and once the teeth stay together so is that of each gear.
#[test]
fn gears_that_have_met_turn_as_one() {
    for (e, begin, rate) in [(0.3, 0.0, 3.0), (0.5, 0.7, 2.0), (0.15, -2.0, 4.0)] {
        let gears = Gears {
            driving: 0.1,
            driven: 0.2,
            play: 0.05,
            torque: 1.0,
            rate,
            e,
        };
        let (whole, until) = (gears.driving + gears.driven, 0.38);
        // While the torque is positive the teeth stay together.
        let speed = gears.torque / (rate * whole) * (rate * until).sin();
        let turned = gears.torque / (rate * rate * whole) * (1.0 - (rate * until).cos());
        for by in METHODS.iter().flat_map(|m| [1e-6, 1e-9].map(|x| (*m, x))) {
            let what = format!("e = {e}, {by:?}");
            let start = state(&[begin, begin], &[0.0, 0.0]);
            let trajectory = run_by(&gears, by, start, until);
            let rest = event(&trajectory, "tooth", "accumulates");
            assert!(rest.time < until, "{what}: {}", rest.time);
            assert!(trajectory.events().len() < 60, "{what}");
            let end = trajectory.final_state();
            let bound = (30.0 * by.1).max(1e-11);
            agree(&what, end.v[0], speed, bound);
            agree(&what, end.v[1], speed, bound);
            agree(&what, end.q[1] - end.q[0], -gears.play, bound);
            let mean = (gears.driving * end.q[0] + gears.driven * end.q[1]) / whole;
            agree(&what, mean - begin, turned, bound);
        }
    }
}
