//! Conditions on angles that are given by their sine or cosine, and on roots: a body passes the ends of their domains, where they have no Taylor series.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, agree, certified, methods_at, run_by, times};

/// A bob on a rod in the plane. How far it has swung is asked in ways that end where it hangs, or where it is at the height of its pivot.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, z),
    kinetic = (der(x)^2 + der(z)^2) / 2,
    potential = gravity * z,
    constraint(rod: x^2 + z^2 == length^2),
    mark(by_arc: acos(-z / length) >= angle),
    mark(by_degrees: 2 * acos(-z / length) * 180 / pi - 10 >= 360 * angle / pi - 10),
    mark(by_root: sqrt(2 * length * (z + length)) >= 2 * length * sin(angle / 2)),
    mark(by_power: (1 + z / length)^(3/2) >= (1 - cos(angle))^(3/2)),
    mark(by_sine: asin(z / length) >= angle - pi/2),
    mark(by_direction: atan2(abs(x), -z) >= angle),
    mark(beyond: acos(-z / length) >= more + pi),
    mark(never_less: asin(z / length) <= -more - 1.6),
)]
struct Pendulum {
    length: f64,
    gravity: f64,
    angle: f64,
    more: f64,
}

/// All the same, as often as the amplitude is beyond the angle: at the instants that the energy says are passed, and never if it does not reach it.
#[test]
fn angles_are_told_by_their_cosine() {
    let mut random = Random::new(571);
    for _ in 0..12 {
        let [length, gravity, angle, amplitude, more] =
            [(0.5, 2.0), (1.0, 20.0), (0.2, 1.2), (0.1, 1.5), (0.0, 9.0)]
                .map(|(low, high)| random.between(low, high));
        let scene = Pendulum {
            length,
            gravity,
            angle,
            more,
        };
        let period = 2.0 * PI * (length / gravity).sqrt();
        let start = || {
            state(
                &[length * amplitude.sin(), -length * amplitude.cos()],
                &[0.0; 2],
            )
        };
        for pair in methods_at(METHODS, [1e-6, 1e-9]) {
            let what = format!("{scene:?} from {amplitude} by {pair:?}");
            let run = run_by(&scene, pair, start(), 2.0 * period);
            certified(&what, &run);
            let told = times(&run, "by_direction", "mark");
            assert_eq!(told.is_empty(), amplitude < angle, "{what}");
            for name in ["by_arc", "by_degrees", "by_root", "by_power", "by_sine"] {
                let also = times(&run, name, "mark");
                assert_eq!(also.len(), told.len(), "{what}: {name}");
                for (a, b) in also.iter().zip(&told) {
                    agree(format!("{what}: {name}"), *a, *b, 1e2 * pair.1);
                }
            }
            for name in ["beyond", "never_less"] {
                assert!(times(&run, name, "mark").is_empty(), "{what}: {name}");
            }
        }
    }
}

/// A body that hangs at rest, where the cosine of its angle is 1 for good.
#[test]
fn what_hangs_at_rest_has_no_angle() {
    let scene = Pendulum {
        length: 0.7,
        gravity: 9.81,
        angle: 0.3,
        more: 0.1,
    };
    for pair in methods_at(METHODS, [1e-9]) {
        let run = run_by(&scene, pair, state(&[0.0, -0.7], &[0.0; 2]), 3.0);
        certified(format!("{pair:?}"), &run);
        assert!(run.events().is_empty(), "{pair:?}");
    }
}
