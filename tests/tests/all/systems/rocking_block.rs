//! A rocking block: its corners are hit in turn, infinitely often in finite time (Housner 1963).

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, event, integral, root, run};

/// Half width b, half height h, turned by θ counter-clockwise about its center.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + mass * (b^2 + h^2)/6 * der(theta)^2,
    potential = mass * gravity * y,
    define(
        left_x = x - b * cos(theta) + h * sin(theta),
        left_y = y - b * sin(theta) - h * cos(theta),
        right_x = x + b * cos(theta) + h * sin(theta),
        right_y = y + b * sin(theta) - h * cos(theta),
    ),
    contact(left: left_y >= 0),
    contact(right: right_y >= 0),
    friction(left_grip on left: slip = der(left_x), static = holds, kinetic = drags),
    friction(right_grip on right: slip = der(right_x), static = holds, kinetic = drags),
    start(leans: theta = -lean, x = h * sin(lean) - b * cos(lean), y = h * cos(lean) + b * sin(lean)),
)]
struct Block {
    mass: f64,
    gravity: f64,
    b: f64,
    h: f64,
    holds: f64,
    drags: f64,
    lean: f64,
}

#[test]
fn the_corners_alternate_until_the_block_rests() {
    for (b, h) in [(0.2, 0.8), (0.3, 0.7)] {
        let block = Block {
            mass: 3.0,
            gravity: 9.81,
            b,
            h,
            holds: 5.0,
            drags: 5.0,
            lean: 0.0,
        };
        let alpha = (b / h).atan();
        let p2 = 0.75 * block.gravity / b.hypot(h);
        // Share of the rate that is left after an impact: moment of momentum about the corner that is hit.
        let share = 1.0 - 1.5 * alpha.sin().powi(2);
        // From level to level, at rate ω: ω(θ)² = 4 p² sin(α − (θ + m)/2) sin((m − θ)/2) with the greatest angle m.
        let half_turn = |rate: f64| {
            let lift = rate * rate / (4.0 * p2);
            let most = root(
                |m| (alpha - 0.5 * m).sin() * (0.5 * m).sin() - lift,
                0.0,
                alpha,
            );
            let slowness = |u: f64| {
                let (back, ahead) = (most * u * u, alpha - most + 0.5 * most * u * u);
                // u/√(sin(m u²/2)) is smooth.
                let ratio = if back > 0.0 {
                    (0.5 * back / (0.5 * back).sin() / (0.5 * most)).sqrt()
                } else {
                    (2.0 / most).sqrt()
                };
                2.0 * most * ratio / (4.0 * p2 * ahead.sin()).sqrt()
            };
            2.0 * integral(slowness, 0.0, 1.0)
        };
        let first = 0.4 * p2.sqrt() * alpha;
        let (mut rate, mut limit) = (first, 0.0);
        while rate > 1e-7 * first {
            limit += half_turn(rate);
            rate *= share;
        }
        // What is left is a geometric series.
        limit += half_turn(rate) / (1.0 - share);
        // Pivoting on the left corner: v = ω × r.
        let start = state(&[0.0, h, 0.0], &[-h * first, b * first, first]);
        let trajectory = run(&block, start, limit + 1.0);
        let impacts: Vec<_> = trajectory
            .events()
            .iter()
            .filter(|e| e.kind == EventKind::Impact)
            .collect();
        for (k, hit) in impacts.iter().take(20).enumerate() {
            let name = hit.subject.name(trajectory.description());
            assert_eq!(name, ["right", "left"][k % 2]);
            let expected = -share * hit.state.v[2];
            agree("rate", -hit.state_after.v[2] / expected, 1.0, 1e-10);
        }
        let mut ends = trajectory.events().iter();
        let rest = ends.find(|e| matches!(e.kind, EventKind::Accumulates { .. }));
        let rest = rest.expect("the impacts accumulate");
        agree("time of rest", rest.time / limit, 1.0, 1e-12);
        assert!(
            matches!(rest.kind, EventKind::Accumulates { impacts: n } if n + 2 >= impacts.len())
        );
        assert!(trajectory.final_mode().contacts.iter().all(|c| *c));
        let end = trajectory.final_state();
        assert!(end.v.iter().all(|v| v.abs() < 1e-14), "{:?}", end.v);
        assert!(end.q[2].abs() < 1e-12);
        agree("height", end.q[1], h, 1e-12);
        assert!(closure(&trajectory) < 1e-10);
    }
}

/// A block that falls back on its other corner may rock on about it, held by friction, or lie down on both and slide: its speeds after each follow
/// from momentum alone. The one with the smaller jump is taken, and the other one told.
#[test]
fn a_block_may_rock_on_or_lie_down() {
    for (b, h, holds, drags, lean) in [
        (0.5, 0.5, 0.7, 0.3, 0.1),
        (0.5, 0.6, 0.65, 0.1, 0.05),
        (0.6, 0.5, 0.8, 0.3, 0.08),
        (0.6, 0.5, 0.8, 0.1, 0.12),
    ] {
        let block = Block {
            mass: 1.0,
            gravity: 9.81,
            b,
            h,
            holds,
            drags,
            lean,
        };
        let record = run(&block, block.at(Block::LEANS), 0.5);
        let event = event(&record, "left", "impact");
        let rate = event.state.v[2];
        let share = 1.0 - 1.5 * b * b / (b * b + h * h);
        let before = [-h * rate, -b * rate, rate];
        let rocks = [-h * share * rate, b * share * rate, share * rate];
        let lies = [drags * b * rate - h * rate, 0.0, 0.0];
        let jump = |after: &[f64; 3]| {
            let change = [0, 1, 2].map(|k| after[k] - before[k]);
            change[0].powi(2) + change[1].powi(2) + (b * b + h * h) / 3.0 * change[2].powi(2)
        };
        let (taken, other) = match jump(&rocks) < jump(&lies) {
            true => (rocks, lies),
            false => (lies, rocks),
        };
        assert!(event.ambiguous, "{block:?}");
        assert_eq!(event.other_impacts.len(), 1, "{block:?}");
        for k in 0..3 {
            agree("taken", event.state_after.v[k], taken[k], 1e-9);
            agree("other", event.other_impacts[0].v_after[k], other[k], 1e-9);
        }
    }
}

/// The same beside a block that rests and a slide on a rough rail, which have nothing to do with it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta, across, up, slide, rise),
    kinetic = (der(x)^2 + der(y)^2) / 2 + (b^2 + h^2)/6 * der(theta)^2
        + (der(across)^2 + der(up)^2 + der(slide)^2 + der(rise)^2) / 2,
    potential = 9.81 * (y + up + rise),
    define(
        left_x = x - b * cos(theta) + h * sin(theta),
        left_y = y - b * sin(theta) - h * cos(theta),
        right_x = x + b * cos(theta) + h * sin(theta),
        right_y = y + b * sin(theta) - h * cos(theta),
    ),
    constraint(rail: rise == 0),
    contact(left: left_y >= 0),
    contact(right: right_y >= 0),
    contact(table: up >= 0),
    friction(left_grip on left: slip = der(left_x), static = holds, kinetic = drags),
    friction(right_grip on right: slip = der(right_x), static = holds, kinetic = drags),
    friction(rests on table: slip = der(across), static = 0.5),
    friction(rubs on rail: slip = der(slide), static = 0.2),
    start(leans: theta = -lean, x = h * sin(lean) - b * cos(lean), y = h * cos(lean) + b * sin(lean), der(slide) = 3),
)]
struct Accompanied {
    b: f64,
    h: f64,
    holds: f64,
    drags: f64,
    lean: f64,
}

/// How many ways there are to go on, and which is taken, is no matter of bodies elsewhere.
#[test]
fn what_is_elsewhere_decides_nothing() {
    for (b, h, holds, drags, lean) in [
        (0.5, 0.5, 0.7, 0.3, 0.1),
        (0.5, 0.6, 0.65, 0.1, 0.05),
        (0.6, 0.5, 0.8, 0.3, 0.08),
        (0.4, 0.6, 0.6, 0.2, 0.1),
    ] {
        let alone = Block {
            mass: 1.0,
            gravity: 9.81,
            b,
            h,
            holds,
            drags,
            lean,
        };
        let beside = Accompanied {
            b,
            h,
            holds,
            drags,
            lean,
        };
        let alone = run(&alone, alone.at(Block::LEANS), 0.5);
        let record = run(&beside, beside.at(Accompanied::LEANS), 0.5);
        let told = |record: &Trajectory<f64>| {
            let event = event(record, "left", "impact");
            let others = event
                .other_impacts
                .iter()
                .map(|other| other.v_after[..3].to_vec());
            (
                event.state_after.v[..3].to_vec(),
                others.collect::<Vec<_>>(),
            )
        };
        let ((taken, others), (taken_beside, others_beside)) = (told(&alone), told(&record));
        assert_eq!(others.len(), others_beside.len());
        let pairs = taken.iter().chain(others.iter().flatten());
        for (x, y) in pairs.zip(taken_beside.iter().chain(others_beside.iter().flatten())) {
            agree("rate", *y, *x, 1e-9);
        }
    }
}
