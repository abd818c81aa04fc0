//! A room whose floor ends at its walls and whose walls end at its floor, told in coordinates that are turned: what holds the motion at an edge holds it
//! there but for rounding.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, agree, certified, methods_at, run_by};

/// A grain that a wind blows into a corner of the room.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, b, z),
    define(depth = cosine * a - sine * z, height = sine * a + cosine * z),
    kinetic = (der(a)^2 + der(b)^2 + der(z)^2) / 2,
    potential = 10 * height + first * depth + second * b,
    contact(floor: height >= 0, where depth >= 0),
    contact(side: depth >= 0, where height >= 0, restitution = bounce),
    contact(end: b >= 0, where height >= 0),
)]
struct Room {
    cosine: f64,
    sine: f64,
    first: f64,
    second: f64,
    bounce: f64,
}

/// However the coordinates are turned, it comes to rest in the corner and through no wall.
#[test]
fn a_grain_blown_into_a_corner_stays_in_the_room() {
    let mut random = Random::new(31);
    for case in 0..24 {
        let angle = random.between(-3.0, 3.0);
        let (sine, cosine) = angle.sin_cos();
        let room = Room {
            cosine,
            sine,
            first: random.between(0.2, 2.0),
            second: random.between(0.2, 2.0),
            bounce: [0.0, 0.5][case % 2],
        };
        let (x, y) = (random.between(0.2, 1.0), random.between(0.2, 1.0));
        let start = || state(&[cosine * x, y, -sine * x], &[0.0; 3]);
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9, 1e-12]) {
            let motion = run_by(&room, (method, tolerance), start(), 20.0);
            let what = format!("{room:?} by {method} at {tolerance:e}");
            for q in &motion.final_state().q {
                agree(&what, *q, 0.0, 1e2 * tolerance);
            }
            certified(&what, &motion);
        }
    }
}
