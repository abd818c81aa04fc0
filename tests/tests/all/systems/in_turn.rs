//! Impacts of several balls at once, together and in turn.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, event, run};

/// Balls on a line.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[5]),
    kinetic = sum(i in 0..5: mass/2 * der(x[i])^2),
    contact(pair[k in 0..4]: x[k+1] - x[k] >= 0, restitution = e),
    impacts = in_turn,
)]
struct Row {
    mass: f64,
    e: f64,
}

#[test]
fn in_turn_as_many_balls_leave_a_cradle_as_come() {
    for released in 1..=3 {
        let scene = Row { mass: 0.2, e: 1.0 };
        let x: Vec<f64> = (0..5)
            .map(|i| if i < released { -1.0 } else { 0.0 })
            .collect();
        let v: Vec<f64> = (0..5)
            .map(|i| if i < released { 1.5 } else { 0.0 })
            .collect();
        let trajectory = run(&scene, state(&x, &v), 2.0);
        for (i, v) in trajectory.final_state().v.iter().enumerate() {
            let expected = if i >= 5 - released { 1.5 } else { 0.0 };
            agree("v", *v, expected, 1e-14);
        }
        assert!(closure(&trajectory) < 1e-14);
    }
    // A simulation may say otherwise: the last four then move as one.
    let scene = Row { mass: 0.2, e: 1.0 };
    let start = state(&[-1.0, 0.0, 0.0, 0.0, 0.0], &[1.0, 0.0, 0.0, 0.0, 0.0]);
    let together = Simulation::new(&scene)
        .impacts(Impacts::Together)
        .run(start, 0.0..2.0)
        .expect("a run");
    for (i, v) in together.final_state().v.iter().enumerate() {
        agree("v", *v, if i == 0 { -0.6 } else { 0.4 }, 1e-14);
    }
}

/// Two balls of mass 1 : 3 fall together; with e = 1 the heavy one bounces first and stays down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(low, high),
    kinetic = heavy/2 * der(low)^2 + light/2 * der(high)^2,
    potential = gravity * (heavy * low + light * high),
    contact(floor: low >= 0, restitution = e),
    contact(pair: high >= low, restitution = e),
    impacts = in_turn,
)]
struct Stack {
    heavy: f64,
    light: f64,
    gravity: f64,
    e: f64,
}

#[test]
fn a_light_ball_on_a_heavy_one_takes_all_the_energy() {
    let scene = Stack {
        heavy: 3.0,
        light: 1.0,
        gravity: 9.81,
        e: 1.0,
    };
    let trajectory = run(&scene, state(&[0.5, 0.5], &[0.0, 0.0]), 0.6);
    let v = (9.81_f64).sqrt();
    let hit = event(&trajectory, "floor", "impact");
    // The floor turns the heavy ball round, then it meets the light one: 0 and twice the speed.
    agree("heavy", hit.state_after.v[0], 0.0, 1e-12);
    agree("light", hit.state_after.v[1], 2.0 * v, 1e-12);
    assert!(closure(&trajectory) < 1e-12);
}

#[test]
fn two_balls_on_each_other_come_to_rest() {
    for (e, impacts) in [
        (0.5, Impacts::Together),
        (0.5, Impacts::InTurn),
        (0.7, Impacts::Together),
    ] {
        let scene = Stack {
            heavy: 1.0,
            light: 0.7,
            gravity: 9.81,
            e,
        };
        let trajectory = Simulation::new(&scene)
            .tolerance(1e-12)
            .impacts(impacts)
            .run(state(&[0.5, 0.9], &[0.0, 0.0]), 0.0..8.0)
            .unwrap_or_else(|f| panic!("{f}"));
        assert_eq!(trajectory.final_mode().contacts, [true, true]);
        let end = trajectory.final_state();
        assert!(
            end.q.iter().chain(&end.v).all(|x| x.abs() < 1e-9),
            "{end:?}"
        );
        let lost = trajectory.ledger().expect("a ledger").end;
        assert!(lost.potential.abs() < 1e-8);
        assert!(closure(&trajectory) < 1e-9);
    }
}
