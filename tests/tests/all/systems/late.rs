//! Late instants: a motion that no coefficient of its series announces, and times that are rounded.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree};

/// A mass whose push begins like t³⁶: up to the largest order the series at t = 0 is that of a mass left alone.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(late: x = (t/scale)^36),
)]
struct Late {
    scale: f64,
}

/// x = v t + s² (t/s)³⁸/(37·38)
#[test]
fn a_step_is_checked_at_its_end_and_not_by_its_coefficients() {
    let scene = Late { scale: 1.5 };
    for tolerance in TOLERANCES {
        let motion = Simulation::new(&scene)
            .tolerance(tolerance)
            .run(state(&[0.0], &[0.25]), 0.0..2.0)
            .expect("a run");
        let part = 2.0_f64 / 1.5;
        let x = 0.5 + 2.25 * part.powi(38) / (37.0 * 38.0);
        let v = 0.25 + 1.5 * part.powi(37) / 37.0;
        let end = motion.final_state();
        agree("x", end.q[0], x, 10.0 * tolerance);
        agree("v", end.v[0], v, 10.0 * tolerance);
    }
}

/// A mass that a fast oscillation drives.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(drive: x = sin(rate * t * 3)),
)]
struct Shaken {
    rate: f64,
}

/// The force is known as well as the time is, which near its zeros is much less than its own digits.
#[test]
fn a_certificate_knows_that_late_times_are_rounded() {
    let scene = Shaken { rate: 7.0 };
    for tolerance in [1e-9, 1e-12] {
        let simulation = Simulation::new(&scene).tolerance(tolerance);
        let run = simulation.run(state(&[0.0], &[0.0]), 0.0..40.0);
        let run = run.expect("a run");
        let x = 40.0 / 21.0 - f64::sin(21.0 * 40.0) / 441.0;
        agree("x", run.final_state().q[0], x, 1e3 * tolerance);
        for seed in 0..10 {
            let certificate = run.verify(seed).expect("recorded");
            assert!(certificate.holds(), "{tolerance:e}, {seed}: {certificate}");
        }
    }
}

/// A mass that nothing drives.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass / 2 * der(x)^2,
)]
struct Free {
    mass: f64,
}

/// One step is enough, however long, although its powers are beyond all numbers.
#[test]
fn a_free_flight_is_one_step_up_to_any_time() {
    for end in [1e3, 1e20, 1e25, 1e300] {
        let simulation = Simulation::new(&Free { mass: 2.0 });
        let run = simulation.run(state(&[1.0], &[3.0]), 0.0..end);
        let run = run.expect("a run");
        agree("x", run.final_state().q[0] / end, 3.0 + 1.0 / end, 1e-15);
        assert_eq!(run.work().steps, 1, "{end:e}");
    }
}

/// A ball that is thrown along a floor, and whose bounces die out.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    start(thrown: y = 0.4, der(x) = 6),
)]
struct ThrownBall {
    gravity: f64,
    bounce: f64,
}

/// The bounces end √(2h/g) (1 + e)/(1 − e) after the start. While the last of them accumulate the ball goes on along the floor, by what the
/// resolution of the time makes of that.
#[test]
fn bounces_die_out_at_any_time() {
    for (gravity, bounce) in [(9.81, 0.5), (3.7, 0.3), (1.6, 0.7)] {
        let ball = ThrownBall { gravity, bounce };
        let fall = (2.0 * 0.4 / gravity).sqrt();
        let lasts = fall * (1.0 + bounce) / (1.0 - bounce);
        for start in [0.0, 1e6, 3e8, 1e9, 4e9] {
            let span = start..start + lasts + 2.0;
            let run = Simulation::new(&ball).run(ball.at(ThrownBall::THROWN), span);
            let run = run.expect("a run");
            let accumulates =
                |event: &&Event<f64>| matches!(event.kind, EventKind::Accumulates { .. });
            let end = run.events().iter().find(accumulates).expect("rests").time;
            agree("end", end - start, lasts, 1e-9 + 2e-15 * start);
            let certificate = run.verify(1).expect("recorded");
            assert!(
                certificate.holds(),
                "{ball:?} from {start:e}: {certificate}"
            );
        }
    }
}

/// A box that slides on a rough floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2*der(x)^2,
    friction(rub: slip = der(x), static = mu, kinetic = mu, normal = 9.81*mass),
    start(pushed: der(x) = speed),
)]
struct Sliding {
    mass: f64,
    mu: f64,
    speed: f64,
}

/// Steps that begin at rest are short, but no shorter than late times are told apart.
#[test]
fn what_comes_to_rest_late_stays_by_every_method() {
    let sliding = Sliding {
        mass: 2.0,
        mu: 0.3,
        speed: 1.4,
    };
    let way = 1.4 * 1.4 / (2.0 * 0.3 * 9.81);
    for method in METHODS {
        for late in [0.0, 3e8, 1.7e9, 1e10] {
            let simulation = Simulation::new(&sliding).method(method);
            let run = simulation.run(sliding.at(Sliding::PUSHED), late..late + 3.0);
            let run = run.expect("a run");
            agree(method, run.final_state().q[0], way, 1e-7);
            agree(method, run.final_state().v[0], 0.0, 1e-12);
        }
    }
}
