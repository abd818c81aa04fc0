//! A ball in a groove: two walls under gravity, hit in any order until the ball rests at the bottom.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, run};

/// A ball between two walls, inclined by `left` and `right` to the horizontal.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
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
