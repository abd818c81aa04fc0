//! An arm whose joints rub and have stops: what rests against a stop does not slip in its bearing.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, event, methods_at, run_by};

/// Two links in a level plane, driven at both joints.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, b),
    define(
        first = [cos(a)/5, sin(a)/5],
        second = [2/5 * cos(a) + 3/20 * cos(a + b), 2/5 * sin(a) + 3/20 * sin(a + b)],
    ),
    kinetic = 2 * dot(der(first), der(first)) + 3/100 * der(a)^2
        + dot(der(second), der(second)) + 1/100 * (der(a) + der(b))^2,
    force(shoulder: a = inner * sin(3 * t)),
    force(elbow: b = outer * cos(3/2 * t)),
    friction(dry_a: slip = der(a), limit = (3/5, 1/2)),
    friction(dry_b: slip = der(b), limit = (6/25, 1/5)),
    contact(high_a: a <= 2, restitution = 3/10),
    contact(low_a: a >= -2, restitution = 3/10),
    contact(high_b: b <= 12/5, restitution = 3/10),
    contact(low_b: b >= -12/5, restitution = 3/10),
    start(straight),
)]
struct Arm {
    inner: f64,
    outer: f64,
}

/// The last bounce before a joint rests can be so low that its gap and its slip vanish at one instant.
#[test]
fn a_joint_at_its_stop_does_not_slip() {
    let joints = [
        (Arm::DRY_A, [Arm::HIGH_A, Arm::LOW_A]),
        (Arm::DRY_B, [Arm::HIGH_B, Arm::LOW_B]),
    ];
    let mut rests = 0;
    for outer in [23.0 / 9.0, 271.0 / 99.0, 273.0 / 99.0] {
        let arm = Arm { inner: 1.0, outer };
        let run = Simulation::new(&arm).run(arm.at(Arm::STRAIGHT), 0.0..10.0);
        let run = run.expect("friction of given strength leaves no doubt");
        for phase in run.phases() {
            for (friction, stops) in joints {
                let stopped = stops.iter().any(|&stop| phase.mode.closed(stop));
                assert!(!stopped || phase.mode.sticks(friction), "{phase:?}");
                rests += usize::from(stopped);
            }
        }
        assert!(run.ledger().expect("a ledger").closure.abs() < 1e-7);
        assert!(run.verify(0).expect("a certificate").holds());
    }
    assert!(rests > 10, "{rests} rests at a stop");
}

/// A slide on a strut that is pushed against its stop ever more.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(s, angle),
    kinetic = der(s)^2/2 + der(angle)^2/2,
    constraint(strut: cos(angle)^2 + (s - sin(angle))^2 == 1),
    force(hand: s = -1 - t),
    contact(stop: s >= stroke),
)]
struct Strut {
    stroke: f64,
}

/// At rest the stop carries the push; no method takes small steps there for ever, although the strut is near a place where its row vanishes.
#[test]
fn a_slide_at_its_stop_takes_few_steps() {
    let strut = Strut { stroke: 0.1 };
    for s in [0.26_f64, 0.35, 0.5] {
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = state(&[s, (s / 2.0).asin()], &[0.0; 2]);
            let motion = run_by(&strut, (method, tolerance), start, 3.0);
            let what = format!("{s} by {method} at {tolerance:e}");
            event(&motion, "stop", "closed");
            let now = motion.sampler().at(3.0).expect("recorded");
            agree(&what, now.force(Strut::STOP), 4.0, 1e-9);
            assert!(motion.work().steps < 600, "{what}: {:?}", motion.work());
        }
    }
}
