//! Several modes could go on: the one that sticks comes first, then the present one, and the event says so.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, event, run, words};

/// A block upon a block, both with dry friction of given limits. The upper one, which is pushed, hits a ball of its own mass,
/// takes its rest, and gives it its speed.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(lower, upper, ball),
    kinetic = light/2 * der(lower)^2 + heavy/2 * (der(upper)^2 + der(ball)^2),
    force(drive: upper = push),
    contact(clack: ball >= upper, restitution = 1),
    friction(ground: slip = der(lower), limit = (ground_static, ground_kinetic)),
    friction(between: slip = der(upper) - der(lower), limit = (between_static, between_kinetic)),
)]
struct Pile {
    light: f64,
    heavy: f64,
    push: f64,
    ground_static: f64,
    ground_kinetic: f64,
    between_static: f64,
    between_kinetic: f64,
}

/// Starts the upper block at 1 m/s, 1 m before the ball.
fn start() -> State<f64> {
    state(&[0.0, 0.0, 1.0], &[0.0, 1.0, 0.0])
}

/// Time to the ball and speed there, accelerated by `a`.
fn arrival(a: f64) -> (f64, f64) {
    let speed = (1.0 + 2.0 * a).sqrt();
    ((speed - 1.0) / a, speed)
}

#[test]
fn what_can_stick_after_a_blow_sticks() {
    // The push could both be held and go on to slip.
    let scene = Pile {
        light: 0.2,
        heavy: 1.0,
        push: 2.0,
        ground_static: 5.0,
        ground_kinetic: 4.0,
        between_static: 3.0,
        between_kinetic: 1.0,
    };
    let motion = run(&scene, start(), 3.0);
    assert_eq!(words(&motion), ["clack impact", "between sticks"]);
    assert!(motion.events().iter().all(|e| !e.ambiguous));
    let (time, speed) = arrival(1.0);
    agree("blow", event(&motion, "clack", "impact").time, time, 1e-12);
    let State { q, v, .. } = motion.final_state();
    agree("upper", q[1], 1.0, 1e-12);
    assert_eq!([v[0], v[1]], [0.0; 2]);
    agree("ball", q[2], 1.0 + speed * (3.0 - time), 1e-12);
}

#[test]
fn of_two_modes_that_stick_as_much_the_present_one_goes_on() {
    // Either block could slip alone, on what then sticks.
    let scene = Pile {
        light: 0.2,
        heavy: 1.0,
        push: 4.0,
        ground_static: 3.0,
        ground_kinetic: 0.5,
        between_static: 1.5,
        between_kinetic: 1.0,
    };
    let (time, _) = arrival(3.0);
    let motion = run(&scene, start(), time + 0.4);
    let State { q, v, .. } = motion.final_state();
    agree("lower", q[0], 0.0, 1e-12);
    agree("upper", q[1], 1.0 + 1.5 * 0.4 * 0.4, 1e-12);
    agree("its speed", v[1], 3.0 * 0.4, 1e-12);
    let last = motion.events().last().expect("the blow");
    assert!(last.ambiguous, "{:?}", words(&motion));
}
