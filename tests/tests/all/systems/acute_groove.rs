//! A mass slides down one side of an acute groove and strikes the other: across the groove it stops, and along it friction may hold it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, certified, methods_at, run_by};

/// The groove runs along y; its sides rise at `left` and `right` from the ground.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    potential = 10 * z,
    contact(one: z * cos(left) - x * sin(left) >= 0),
    friction(grip on one: slip = (der(y), der(x) * cos(left) + der(z) * sin(left)), static = mu),
    contact(two: z * cos(right) + x * sin(right) >= 0),
    friction(hold on two: slip = (der(y), der(x) * cos(right) - der(z) * sin(right)), static = mu),
)]
struct Groove {
    left: f64,
    right: f64,
    mu: f64,
}

const ANGLES: [(f64, f64); 5] = [(1.0, 1.0), (0.9, 1.1), (1.3, 0.7), (0.8, 0.8), (1.2, 0.6)];

/// The mass starts on the second side, `down` it by so much, and slides along the groove.
fn start(right: f64, along: f64) -> State<f64> {
    let up = 0.5;
    state(
        &[-up * right.cos(), 0.0, up * right.sin()],
        &[0.0, along, 0.0],
    )
}

/// Without friction the speed along the groove stays.
#[test]
fn without_friction_it_goes_on_along_the_groove() {
    for (left, right) in ANGLES {
        let groove = Groove {
            left,
            right,
            mu: 0.0,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-9]) {
            let run = run_by(&groove, (method, tolerance), start(right, 0.3), 2.0);
            let state = run.final_state();
            let [x, y, z] = [0, 1, 2].map(|i| state.q[i]);
            assert!(
                x.abs().max(z.abs()) < 1e-8,
                "{left} {right} {method:?}: {x} {z}"
            );
            assert!((y - 0.6).abs() < 1e-8, "{left} {right} {method:?}: {y}");
            certified(format!("{left} {right} {method}"), &run);
        }
    }
}

/// Both surfaces push and hold together: the mass is at rest from the impact on, also where one of the least impulses that stop it is zero.
#[test]
fn friction_holds_it_between_both() {
    let mut random = Random::new(561);
    let slow = [(1.0, 1.0, 0.2, 0.3)];
    let random = core::iter::repeat_with(|| {
        let [left, right] = [0, 1].map(|_| random.between(0.9, 1.2));
        (
            left,
            right,
            random.between(0.25, 0.7),
            random.between(0.0, 0.3),
        )
    });
    for (left, right, mu, along) in slow.into_iter().chain(random.take(12)) {
        let groove = Groove { left, right, mu };
        for (method, tolerance) in methods_at(METHODS, [1e-9]) {
            let what = format!("{left} {right} {mu} {along} {method}");
            let run = run_by(&groove, (method, tolerance), start(right, along), 1.0);
            let hit = run
                .events()
                .iter()
                .find(|event| event.kind == EventKind::Impact);
            let hit = hit.expect("an impact");
            let after = hit
                .state_after
                .v
                .iter()
                .fold(0.0_f64, |most, v| most.max(v.abs()));
            assert!(after < 1e-12, "{what}: {after}");
            assert_eq!(run.final_state().q, hit.state_after.q, "{what}");
            certified(what, &run);
        }
    }
}
