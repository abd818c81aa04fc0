//! An arm of two links that weigh nothing, with a mass in its hand: the hand falls freely as long as the arm is bent. Where the arm is
//! stretched its mass matrix loses rank.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{TOLERANCES, agree, methods_at};

/// The links have the angles a and b with the vertical.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, b),
    define(x = upper * sin(a) + lower * sin(b), y = -upper * cos(a) - lower * cos(b)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * 9.81 * y,
)]
struct Arm {
    mass: f64,
    upper: f64,
    lower: f64,
}

/// det M = (m l₁ l₂ sin(a − b))² falls to zero, and with it the digits of the angular accelerations. A run must end before it has
/// fewer than were asked for, and the hand has fallen freely until then.
#[test]
fn a_run_ends_before_rounding_is_all_that_is_left_of_its_inertia() {
    let arm = Arm {
        mass: 1.3,
        upper: 0.7,
        lower: 0.5,
    };
    let (a, b, rate_a, rate_b): (f64, f64, f64, f64) = (0.9, 2.0, 0.4, -0.9);
    let [x, y] = [
        arm.upper * a.sin() + arm.lower * b.sin(),
        -arm.upper * a.cos() - arm.lower * b.cos(),
    ];
    let [along, up] = [
        arm.upper * a.cos() * rate_a + arm.lower * b.cos() * rate_b,
        arm.upper * a.sin() * rate_a + arm.lower * b.sin() * rate_b,
    ];
    let hand = |t: f64| [x + along * t, y + up * t - 0.5 * 9.81 * t * t];
    let reach = |t: f64| hand(t)[0].hypot(hand(t)[1]) - arm.upper - arm.lower;
    let stretched = lagrange_tests::root(reach, 0.05, 2.0);
    for (method, tolerance) in methods_at(["auto", "dop853", "verner98", "radau5"], TOLERANCES) {
        let simulation = Simulation::new(&arm)
            .method(method.parse().expect("a method"))
            .tolerance(tolerance);
        let what = format!("{method} {tolerance:e}");
        let start = state(&[a, b], &[rate_a, rate_b]);
        let Err(failure) = simulation.run(start, 0.0..2.0) else {
            panic!("{what}: the arm is longer than its links");
        };
        let Error::Singular { time, .. } = failure.error else {
            panic!("{what}: {failure}");
        };
        let early = (stretched - time).abs();
        assert!(early < 1e-2, "{what}: {time} instead of {stretched}");
        let run = failure.trajectory;
        let certificate = run.verify(0).expect("it is recorded");
        assert!(certificate.holds(), "{what}: {certificate}");
        let [x, y] = hand(run.last_time());
        let q = &run.final_state().q;
        let found = [
            arm.upper * q[0].sin() + arm.lower * q[1].sin(),
            -arm.upper * q[0].cos() - arm.lower * q[1].cos(),
        ];
        agree(&what, found[0], x, 100.0 * tolerance);
        agree(&what, found[1], y, 100.0 * tolerance);
    }
}
