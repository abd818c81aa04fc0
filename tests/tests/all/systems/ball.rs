//! A bouncing ball: geometric impacts and the limit of their times; a moving table; a ceiling that is grazed.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, event, run, words};

/// A ball that bounces on the floor while it moves sideways.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = bounce),
)]
struct Ball {
    mass: f64,
    gravity: f64,
    bounce: f64,
}

#[test]
fn a_bouncing_ball_comes_to_rest_at_the_limit_of_its_impacts() {
    for bounce in [0.3, 0.5, 0.8, 0.9] {
        let ball = Ball {
            mass: 1.0,
            gravity: 9.81,
            bounce,
        };
        let trajectory = run(&ball, state(&[0.0, 1.0], &[0.0, 0.0]), 50.0);
        let fall = (2.0 / 9.81_f64).sqrt();
        let impacts: Vec<f64> = trajectory
            .events()
            .iter()
            .filter(|e| e.kind == EventKind::Impact)
            .map(|e| e.time)
            .collect();
        let mut expected = fall;
        for (k, time) in impacts.iter().take(8).enumerate() {
            agree("impact", *time, expected, 1e-12);
            expected += 2.0 * fall * bounce.powi(k as i32 + 1);
        }
        let limit = fall * (1.0 + bounce) / (1.0 - bounce);
        let rest = event(&trajectory, "floor", "accumulates");
        agree("limit", rest.time, limit, 1e-12);
        assert_eq!(trajectory.final_mode().contacts, [true]);
        assert_eq!(trajectory.final_state().v[1], 0.0);
        assert!(closure(&trajectory) < 1e-10);
    }
}

#[test]
fn a_ball_that_moves_sideways_does_not_come_to_rest_too_early() {
    let ball = Ball {
        mass: 1.0,
        gravity: 9.81,
        bounce: 0.5,
    };
    let trajectory = run(&ball, state(&[0.0, 1.0], &[2.0, 0.0]), 3.0);
    agree("x", trajectory.final_state().q[0], 6.0, 1e-11);
    agree(
        "limit",
        event(&trajectory, "floor", "accumulates").time,
        3.0 * (2.0 / 9.81_f64).sqrt(),
        1e-11,
    );
}

/// A ball on a table that moves up and down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = mass/2 * der(y)^2,
    potential = mass * gravity * y,
    contact(table: y >= amplitude * sin(rate * t), restitution = bounce),
)]
struct Table {
    mass: f64,
    gravity: f64,
    amplitude: f64,
    rate: f64,
    bounce: f64,
}

/// It leaves where the table's deceleration is g: sin ωt = g/(A ω²).
#[test]
fn a_ball_on_a_moving_table_leaves_where_the_table_falls_faster() {
    let (amplitude, rate, gravity, bounce) = (0.1_f64, 12.0_f64, 9.81, 0.5);
    let scene = Table {
        mass: 0.3,
        gravity,
        amplitude,
        rate,
        bounce,
    };
    let trajectory = run(&scene, state(&[0.0], &[amplitude * rate]), 0.3);
    let leave = (gravity / (amplitude * rate * rate)).asin() / rate;
    let lost = event(&trajectory, "table", "lost");
    agree("leaves", lost.time, leave, 1e-11);
    assert!(closure(&trajectory) < 1e-10);
}

/// A ball under a ceiling.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = mass/2 * der(y)^2,
    potential = mass * gravity * y,
    contact(ceiling: y <= height, restitution = 1),
)]
struct Ceiling {
    mass: f64,
    gravity: f64,
    height: f64,
}

#[test]
fn a_ceiling_is_missed_grazed_or_hit() {
    let (gravity, speed) = (9.81, 4.0);
    let apex: f64 = speed * speed / (2.0 * gravity);
    for (above, hits) in [(1e-9, Some(false)), (-1e-9, Some(true)), (0.0, None)] {
        let scene = Ceiling {
            mass: 1.0,
            gravity,
            height: apex * (1.0 + above),
        };
        let trajectory = run(&scene, state(&[0.0], &[speed]), 0.7);
        let told = words(&trajectory);
        if let Some(hits) = hits {
            let expected: &[&str] = if hits { &["ceiling impact"] } else { &[] };
            assert_eq!(told, expected);
        }
        if hits == Some(true) {
            let rest = (2.0 * gravity * 1e-9 * apex).sqrt();
            let hit = &trajectory.events()[0];
            // The height is known to 1e-16, so the time of a graze to √1e-16.
            agree("time", hit.time, (speed - rest) / gravity, 1e-10);
            agree("v", hit.state_after.v[0], -rest, 1e-9);
        }
        // An elastic graze only cuts the tip off the parabola.
        let cut = if hits == Some(true) {
            2.0 * (2.0 * gravity * 1e-9 * apex).sqrt() / gravity
        } else {
            0.0
        };
        let t = 0.7 + cut;
        let end = speed * t - 0.5 * gravity * t * t;
        agree("y", trajectory.final_state().q[0], end, 1e-9);
    }
}

/// Two balls over one floor, that know nothing of each other.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y[2]),
    kinetic = sum(k in 0..2: mass[k]/2 * der(y[k])^2),
    potential = sum(k in 0..2: mass[k] * gravity * y[k]),
    contact(floor[k in 0..2]: y[k] >= 0, restitution = bounce),
)]
struct TwoBalls {
    mass: [f64; 2],
    gravity: f64,
    bounce: f64,
}

#[test]
fn two_balls_that_land_together_do_as_each_alone() {
    let scene = TwoBalls {
        mass: [1.0, 3.0],
        gravity: 9.81,
        bounce: 0.5,
    };
    let alone = Ball {
        mass: 1.0,
        gravity: 9.81,
        bounce: 0.5,
    };
    let pair = run(&scene, state(&[1.0, 1.0], &[0.0, 0.0]), 3.0);
    let single = run(&alone, state(&[0.0, 1.0], &[0.0, 0.0]), 3.0);
    for k in 0..=60 {
        let t = 0.05 * f64::from(k);
        let (a, b) = (pair.sampler().at(t), single.sampler().at(t));
        let (a, b) = (a.expect("inside"), b.expect("inside"));
        agree("first", a.state.q[0], b.state.q[1], 1e-11);
        agree("second", a.state.q[1], b.state.q[1], 1e-11);
    }
    assert_eq!(pair.final_mode().contacts, [true, true]);
    // From different heights they come to rest at different times.
    let pair = run(&scene, state(&[1.0, 0.3], &[0.0, 0.0]), 3.0);
    let ends: Vec<f64> = pair
        .events()
        .iter()
        .filter(|e| matches!(e.kind, EventKind::Accumulates { .. }))
        .map(|e| e.time)
        .collect();
    let limit = |h: f64| 3.0 * (2.0 * h / 9.81).sqrt();
    assert_eq!(ends.len(), 2, "{:?}", words(&pair));
    agree("second", ends[0], limit(0.3), 1e-11);
    agree("first", ends[1], limit(1.0), 1e-11);
}

/// A ball that flies into a corner.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(wall: x >= 0, restitution = 1),
    contact(floor: y >= 0, restitution = 1),
)]
struct Corner {
    mass: f64,
}

#[test]
fn a_ball_in_a_corner_comes_back() {
    let scene = Corner { mass: 2.0 };
    let trajectory = run(&scene, state(&[1.0, 0.5], &[-1.0, -0.5]), 3.0);
    assert_eq!(words(&trajectory), ["wall impact", "floor impact"]);
    assert_eq!(trajectory.events()[0].time, trajectory.events()[1].time);
    agree("x", trajectory.final_state().q[0], 2.0, 1e-14);
    agree("y", trajectory.final_state().q[1], 1.0, 1e-14);
}
