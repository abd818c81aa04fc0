//! Surfaces that are hit so slowly that rounding hardly tells when: stops and marks at their very place are reached, those a little beyond are not.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, certified, run_by, times, words};

const METHODS: [&str; 6] = [
    "taylor", "dop853", "dopri5", "verner98", "radau5", "rk4:1e-3",
];

/// What is left of the way to the turning point where the surface is hit.
const LEFT: [f64; 4] = [1e-3, 1e-5, 1e-6, 1e-7];

/// A ball is thrown up to a ceiling, which is marked in several ways.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    potential = gravity * y,
    contact(ceiling: y <= height, restitution = bounce),
    mark(there: y >= height),
    mark(left: height - y <= 0),
    mark(twice: 2 * y >= 2 * height),
    mark(passed: y - height),
    mark(beyond: y >= height + more),
)]
struct Ball {
    gravity: f64,
    height: f64,
    bounce: f64,
    more: f64,
}

/// It comes to height h after v/g − √(v² − 2gh)/g, hits the ceiling once, and is then below it or, where nothing of its speed is left, falls off.
#[test]
fn marks_on_a_ceiling_are_passed_once() {
    let gravity = 1.7;
    for (highest, bounce) in [(0.45, 0.0), (1.0, 0.3), (2.6, 1.0)] {
        let speed = (2.0 * gravity * highest).sqrt();
        for left in LEFT {
            let height = highest - left;
            let ball = Ball {
                gravity,
                height,
                bounce,
                more: 0.1 * left,
            };
            let hits = (speed - (2.0 * gravity * left).sqrt()) / gravity;
            for method in METHODS {
                let what = format!("{method}, {highest} - {left:e}");
                let run = run_by(&ball, (method, 1e-12), state(&[0.0], &[speed]), 1.5 * hits);
                assert_eq!(times(&run, "ceiling", "impact").len(), 1, "{what}");
                for mark in ["there", "left", "twice"] {
                    let [time] = times(&run, mark, "mark")[..] else {
                        panic!("{what}, {mark}: {:?}", words(&run));
                    };
                    agree(&what, time, hits, 1e-10 / left.sqrt());
                }
                assert_eq!(times(&run, "beyond", "mark"), [0.0; 0], "{what}");
                certified(&what, &run);
            }
        }
    }
}

/// A mass on springs, in a ring that is also a stop.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = stiffness/2 * (x^2 + y^2),
    contact(ring: sqrt(x^2 + y^2) <= radius, restitution = 1/2),
    stop(struck: sqrt(x^2 + y^2) >= radius + more),
)]
struct Ring {
    mass: f64,
    stiffness: f64,
    radius: f64,
    more: f64,
}

/// On its ellipse with the half axes a and b, which begins at b, it comes to a distance r when sin²(ωt) = (r² − b²)/(a² − b²).
#[test]
fn a_stop_on_a_ring_ends_the_run_before_the_impact() {
    let (mass, stiffness) = (0.7, 3.1);
    let rate = f64::sqrt(stiffness / mass);
    for [a, b] in [[1.3, 0.6], [0.9, 0.35]] {
        for left in LEFT {
            let radius = a - left;
            let share = (radius * radius - b * b) / (a * a - b * b);
            let hits = share.sqrt().asin() / rate;
            for method in METHODS {
                let what = format!("{method}, {a} - {left:e}");
                let run = |more: f64| {
                    let ring = Ring {
                        mass,
                        stiffness,
                        radius,
                        more,
                    };
                    let start = state(&[0.0, b], &[a * rate, 0.0]);
                    run_by(&ring, (method, 1e-12), start, 1.3 * hits)
                };
                let stopped = run(0.0);
                assert_eq!(words(&stopped), ["struck stop"], "{what}");
                agree(&what, stopped.last_time(), hits, 1e-10 / left.sqrt());
                certified(&what, &stopped);
                assert_eq!(words(&run(0.1 * left)), ["ring impact"], "{what}");
            }
        }
    }
}
