//! Impacts while other contacts, frictions and constraints act.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, event, run, words};

/// A block slides on the floor into a wall that leans over it by β.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    contact(wall: distance - x * cos(lean) - y * sin(lean) >= 0, restitution = e),
    friction(rub on floor: slip = der(x), static = mu),
)]
struct LeaningWall {
    mass: f64,
    gravity: f64,
    distance: f64,
    lean: f64,
    mu: f64,
    e: f64,
}

/// The wall presses the block onto the floor, where the impulse has its friction.
#[test]
fn a_contact_that_is_closed_takes_part_in_an_impact_with_its_friction() {
    let (mass, lean, mu, e) = (2.0, 0.4_f64, 0.3, 0.5);
    let scene = LeaningWall {
        mass,
        gravity: 9.81,
        distance: 1.0,
        lean,
        mu,
        e,
    };
    let trajectory = run(&scene, state(&[0.0, 0.0], &[4.0, 0.0]), 0.5);
    let hit = event(&trajectory, "wall", "impact");
    let v = (16.0_f64 - 2.0 * mu * 9.81 / lean.cos()).sqrt();
    agree("arrives with", hit.state.v[0], v, 1e-11);
    // It slides back: friction pushes forward. vx⁺ = −e vx, vy⁺ = 0.
    let blow = mass * (1.0 + e) * v / (lean.cos() - mu * lean.sin());
    agree("blow", hit.impulses[1], blow, 1e-11);
    agree("floor", hit.impulses[0], blow * lean.sin(), 1e-11);
    agree("friction", hit.impulses[2], mu * blow * lean.sin(), 1e-11);
    agree("leaves with", hit.state_after.v[0], -e * v, 1e-11);
    assert_eq!(hit.state_after.v[1], 0.0);
    assert!(hit.after.contacts[0] && !hit.after.contacts[1]);
    assert!(closure(&trajectory) < 1e-11);
}

#[test]
fn an_impact_at_the_first_instant_is_an_impact() {
    let scene = LeaningWall {
        mass: 1.0,
        gravity: 9.81,
        distance: 0.0,
        lean: 0.0,
        mu: 0.0,
        e: 0.25,
    };
    let trajectory = run(&scene, state(&[0.0, 0.0], &[2.0, 0.0]), 1.0);
    assert_eq!(words(&trajectory), ["wall impact", "rub reverses"]);
    assert_eq!(trajectory.events()[0].time, 0.0);
    agree("v", trajectory.final_state().v[0], -0.5, 1e-14);
    // At rest on the wall, or leaving it, nothing happens.
    for v in [0.0, -1.0] {
        let trajectory = run(&scene, state(&[0.0, 0.0], &[v, 0.0]), 1.0);
        let hits = words(&trajectory);
        assert!(!hits.iter().any(|w| w == "wall impact"), "{hits:?}");
        agree("v", trajectory.final_state().v[0], v, 1e-14);
    }
}

/// A bead on a rough straight wire flies against an inclined plate.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    constraint(wire: y == 0),
    contact(plate: distance - x * cos(lean) - y * sin(lean) >= 0, restitution = e),
    friction(rub on wire: slip = der(x), static = mu),
)]
struct BeadAndPlate {
    mass: f64,
    distance: f64,
    lean: f64,
    mu: f64,
    e: f64,
}

#[test]
fn friction_on_a_constraint_acts_in_an_impact_whichever_side_presses() {
    for lean in [0.4_f64, -0.4] {
        let (mass, mu, e) = (2.0, 0.3, 0.5);
        let scene = BeadAndPlate {
            mass,
            distance: 1.0,
            lean,
            mu,
            e,
        };
        let trajectory = run(&scene, state(&[0.0, 0.0], &[4.0, 0.0]), 0.5);
        let hit = event(&trajectory, "plate", "impact");
        let blow = mass * (1.0 + e) * 4.0 / (lean.cos() - mu * lean.sin().abs());
        agree("blow", hit.impulses[1], blow, 1e-13);
        agree("wire", hit.impulses[0], blow * lean.sin(), 1e-13);
        agree(
            "friction",
            hit.impulses[2],
            mu * blow * lean.sin().abs(),
            1e-13,
        );
        agree("leaves with", hit.state_after.v[0], -2.0, 1e-13);
        assert!(closure(&trajectory) < 1e-12);
    }
}

/// A block that a clamp holds, struck by a ball.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, ball),
    kinetic = mass/2 * der(x)^2 + light/2 * der(ball)^2,
    contact(face: x >= ball, restitution = e),
    friction(clamp: slip = der(x), limit = (hold, drag)),
)]
struct Clamped {
    mass: f64,
    light: f64,
    e: f64,
    hold: f64,
    drag: f64,
}

/// A finite force does nothing in no time: the block moves off and is then braked.
#[test]
fn a_friction_of_given_limit_slips_after_a_blow() {
    let scene = Clamped {
        mass: 2.0,
        light: 0.5,
        e: 0.5,
        hold: 8.0,
        drag: 3.0,
    };
    let trajectory = run(&scene, state(&[0.0, -1.0], &[0.0, 4.0]), 2.0);
    let v = 0.5 * 1.5 * 4.0 / 2.5;
    let hit = event(&trajectory, "face", "impact");
    agree("block", hit.state_after.v[0], v, 1e-14);
    assert_eq!(
        words(&trajectory),
        ["face impact", "clamp slips", "clamp sticks"]
    );
    let stop = event(&trajectory, "clamp", "sticks");
    agree("stops", stop.time, 0.25 + v * 2.0 / 3.0, 1e-11);
    agree("after", stop.state.q[0], v * v * 2.0 / 6.0, 1e-11);
    assert!(closure(&trajectory) < 1e-11);
}

/// Three supports under a beam that falls flat: more contacts than a plane needs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y, theta),
    kinetic = mass/2 * der(y)^2 + inertia/2 * der(theta)^2,
    potential = mass * gravity * y,
    contact(support[k in 0..3]: y + place[k] * sin(theta) >= 0, restitution = e),
)]
struct Beam {
    mass: f64,
    inertia: f64,
    gravity: f64,
    place: [f64; 3],
    e: f64,
}

#[test]
fn impulses_of_three_supports_are_shared_and_flagged() {
    let scene = Beam {
        mass: 3.0,
        inertia: 0.4,
        gravity: 9.81,
        place: [-1.0, 0.0, 1.0],
        e: 0.5,
    };
    let trajectory = run(&scene, state(&[0.2, 0.0], &[0.0, 0.0]), 0.3);
    let hits: Vec<_> = trajectory
        .events()
        .iter()
        .filter(|e| e.kind == EventKind::Impact)
        .collect();
    assert_eq!(hits.len(), 3, "{:?}", words(&trajectory));
    let v = (2.0_f64 * 9.81 * 0.2).sqrt();
    for hit in hits {
        assert!(hit.impulses_undetermined);
        // Least norm: a third each.
        for k in 0..3 {
            agree("share", hit.impulses[k], 1.5 * v, 1e-11);
        }
        agree("v", hit.state_after.v[0], 0.5 * v, 1e-11);
        assert!(hit.state_after.v[1].abs() < 1e-13);
    }
}

/// A ball dropped onto a belt that runs, over a floor that rises.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(floor: y >= rise * t, restitution = e),
    friction(rub on floor: slip = der(x) - belt, static = mu),
)]
struct Belt {
    mass: f64,
    rise: f64,
    belt: f64,
    mu: f64,
    e: f64,
}

#[test]
fn surfaces_that_move_do_work_that_the_ledger_books() {
    let scene = Belt {
        mass: 0.7,
        rise: 0.5,
        belt: 3.0,
        mu: 0.2,
        e: 0.8,
    };
    let trajectory = run(&scene, state(&[0.0, 1.0], &[0.0, -2.0]), 1.0);
    let hit = event(&trajectory, "floor", "impact");
    agree("time", hit.time, 0.4, 1e-13);
    agree("up", hit.state_after.v[1], 0.5 + 0.8 * 2.5, 1e-13);
    agree("along", hit.state_after.v[0], 0.2 * 1.8 * 2.5, 1e-13);
    assert!(!hit.restitution_lowered);
    assert!(closure(&trajectory) < 1e-13);
}
