//! A ball in a groove: two walls under gravity, hit in any order until the ball rests at the bottom.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, agree, certified, closure, methods_at, run, run_by,
};

/// A ball between two walls, inclined by `left` and `right` to the horizontal.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(falling: x * sin(left) + y * cos(left) >= 0, restitution = e),
    contact(rising: y * cos(right) - x * sin(right) >= 0, restitution = e),
)]
struct Groove {
    mass: f64,
    gravity: f64,
    left: f64,
    right: f64,
    e: f64,
}

/// When a body that is at distance `d` from a wall and parts from it with `v` has bounced infinitely often.
fn rests(d: f64, v: f64, g: f64, e: f64) -> f64 {
    let arrival = (v * v + 2.0 * g * d).sqrt();
    (v + arrival) / g + 2.0 * arrival * e / (g * (1.0 - e))
}

#[test]
fn perpendicular_walls_do_not_know_of_each_other() {
    for (left, e) in [(0.7, 0.5), (0.25 * PI, 0.8), (1.2, 0.9)] {
        let groove = Groove {
            mass: 1.3,
            gravity: 9.81,
            left,
            right: 0.5 * PI - left,
            e,
        };
        let (g, d, v) = (groove.gravity, [0.4, 0.7], [0.3, -0.2]);
        // Distances from the walls as coordinates.
        let (s, c) = left.sin_cos();
        let place = |d: [f64; 2]| [d[0] * s - d[1] * c, d[0] * c + d[1] * s];
        let start = state(&place(d), &place(v));
        let limits = [rests(d[0], v[0], g * c, e), rests(d[1], v[1], g * s, e)];
        let trajectory = run(&groove, start, limits[0].max(limits[1]) + 0.5);
        for (k, limit) in limits.into_iter().enumerate() {
            let mut events = trajectory.events().iter();
            let rest = events.find(|event| {
                event.subject == Subject::Contact(k)
                    && matches!(event.kind, EventKind::Accumulates { .. })
            });
            let rest = rest.expect("the wall accumulates");
            // Along the walls the ball is off the origin: rounding leaves 1e-17 m of a distance, at 1e-6 m/s.
            agree("time of rest", rest.time / limit, 1.0, 1e-10);
        }
        assert!(trajectory.final_state().q.iter().all(|q| q.abs() < 1e-11));
        assert!(closure(&trajectory) < 1e-10);
    }
}

#[test]
fn any_groove_ends_in_its_bottom() {
    for (left, right, e) in [
        (0.3, 0.4, 0.3),
        (0.9, 0.5, 0.6),
        (1.0, 1.0, 0.5),
        (1.2, 1.3, 0.4),
        (0.2, 1.3, 0.7),
    ] {
        let groove = Groove {
            mass: 1.0,
            gravity: 9.81,
            left,
            right,
            e,
        };
        let trajectory = run(&groove, state(&[0.03, 0.5], &[0.1, 0.0]), 60.0);
        let end = trajectory.final_state();
        assert_eq!(
            trajectory.final_mode().contacts,
            [true, true],
            "{left} {right} {e}"
        );
        assert!(
            end.q.iter().chain(&end.v).all(|x| x.abs() < 1e-9),
            "{end:?}"
        );
        assert!(closure(&trajectory) < 1e-9);
    }
}

/// What is shaken off the bottom of a valley falls back onto it, where rounding has put it on one side or the other.
#[test]
fn a_ball_falls_back_to_the_bottom() {
    for (up, down) in [(2.0, 2.0), (3.0, 3.0), (0.5, 0.5), (1.0, 0.3)] {
        for (beside, drift) in [(0.0, 0.0), (1e-15, -1e-17), (-1e-16, 1e-17), (1e-3, 0.0)] {
            let valley = Valley {
                up,
                down,
                bent: 0.0,
                e: 0.0,
                mu: 0.0,
                bottom: 0.0,
                speed: 0.0,
                swing: 0.5,
                rate: 5.0,
            };
            let all = methods_at(METHODS, TOLERANCES);
            // Methods of low order take most of the time at the tightest tolerance.
            for (method, tolerance) in all.filter(|(_, tolerance)| up == 2.0 || *tolerance > 1e-12)
            {
                let what = format!("{valley:?} from {beside:e} by {method} at {tolerance:e}");
                let start = state(&[beside, up.max(-down) * f64::abs(beside)], &[drift, 2.5]);
                let motion = run_by(&valley, (method, tolerance), start, 4.0);
                let State { q, .. } = motion.final_state();
                // Neither surface has let it through.
                let bottom = 0.5 * 20.0_f64.sin();
                assert!(q[1] > bottom - 1e-6 && q[0].abs() < 0.1, "{what}: {q:?}");
                certified(&what, &motion);
            }
        }
    }
}

/// A ball in a valley that moves, whose sides are surfaces that end at each other, at its bottom.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    define(beside = x - bottom - speed*t, above = y - swing*sin(rate*t)),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = 9.81*y,
    contact(rising: above >= up*beside + bent*beside^2, where beside >= 0, restitution = e),
    contact(falling: above >= -down*beside + bent*beside^2, where beside <= 0, restitution = e),
    friction(grips on rising: slip = der(beside) + up*der(above), static = mu),
    friction(holds on falling: slip = der(beside) - down*der(above), static = mu),
)]
struct Valley {
    up: f64,
    down: f64,
    bent: f64,
    e: f64,
    mu: f64,
    bottom: f64,
    speed: f64,
    swing: f64,
    rate: f64,
}

/// However it is hit, the ball bounces ever lower and comes to rest at the bottom, where neither side alone would hold it.
#[test]
fn sides_that_end_at_each_other_hold_a_ball_at_the_bottom() {
    let mut random = Random::new(54);
    for round in 0..12 {
        let valley = Valley {
            up: random.between(0.4, 1.8),
            down: random.between(0.4, 1.8),
            bent: [0.0, 0.6][round % 2],
            e: [0.0, 0.3, 0.6, 0.75][round % 4],
            mu: [0.0, 0.2][round / 2 % 2],
            bottom: [0.0, 1.7][round / 4 % 2],
            speed: [0.0, 0.5, -0.3][round % 3],
            swing: [0.0, 0.01][round / 6],
            rate: 4.0,
        };
        let beside = random.between(0.05, 0.3);
        let height = valley.up * beside + valley.bent * beside * beside;
        let start = state(
            &[valley.bottom + beside, height + 0.1],
            &[valley.speed, valley.swing * valley.rate],
        );
        let all = methods_at(METHODS, TOLERANCES);
        for (method, tolerance) in all.filter(|(_, tolerance)| round < 4 || *tolerance > 1e-12) {
            let what = format!("{valley:?} by {method} at {tolerance:e}");
            let motion = run_by(&valley, (method, tolerance), start.clone(), 5.0);
            let State { q, .. } = motion.final_state();
            agree(
                &what,
                q[0],
                valley.bottom + 5.0 * valley.speed,
                10.0 * tolerance,
            );
            agree(
                &what,
                q[1],
                valley.swing * (5.0 * valley.rate).sin(),
                10.0 * tolerance,
            );
            certified(&what, &motion);
        }
    }
}

/// Surfaces that end at each other on a ridge hold nothing: a ball that is put beside it slides down.
#[test]
fn sides_of_a_ridge_hold_nothing_beyond_it() {
    let ridge = Valley {
        up: -0.7,
        down: -0.4,
        bent: 0.0,
        e: 0.0,
        mu: 0.0,
        bottom: 0.0,
        speed: 0.0,
        swing: 0.0,
        rate: 1.0,
    };
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        for (beside, side) in [(1e-3, -0.7), (-1e-3, 0.4)] {
            let what = format!("from {beside:e} by {method} at {tolerance:e}");
            let start = state(&[beside, side * beside], &[0.0, 0.0]);
            let motion = run_by(&ridge, (method, tolerance), start, 1.0);
            // Along a slope m it accelerates by −g m/(1 + m²).
            let goes = beside - 9.81 / 2.0 * side / (1.0 + side * side);
            let State { q, .. } = motion.final_state();
            agree(&what, q[0], goes, 100.0 * tolerance);
            agree(&what, q[1], side * goes, 100.0 * tolerance);
            certified(&what, &motion);
        }
    }
}
