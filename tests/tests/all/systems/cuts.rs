//! Forces that jump or bend where no branch says so: at the cut of an angle, and in the middle of a funnel.

use super::{PI, state};
use core::f64::consts::TAU;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, event, methods_at, root, run_by};

/// A rudder steers a boat back to its course, by the angle between −π and π.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(heading),
    kinetic = der(heading)^2 / 2,
    force(rudder: heading = -gain * atan2(sin(heading), cos(heading))),
)]
struct Boat {
    gain: f64,
}

/// The heading and its rate after a time, when it starts on its course: from cut to cut an oscillation about the whole turn that is nearest.
fn steered(gain: f64, rate: f64, until: f64) -> [f64; 2] {
    let w = gain.sqrt();
    let (mut turns, mut left) = (0.0, until);
    let [mut angle, mut rate] = [0.0, rate];
    loop {
        let at = |t: f64| {
            let (s, c) = (w * t).sin_cos();
            [angle * c + rate / w * s, rate * c - w * angle * s]
        };
        // Until the angle is largest, unless it is beyond the cut then.
        let largest = (rate / w).atan2(angle).rem_euclid(PI) / w;
        let top = at(largest)[0];
        if top.abs() > PI {
            let cut = root(|t| top.signum() * at(t)[0] - PI, 0.0, largest);
            if cut < left {
                left -= cut;
                rate = at(cut)[1];
                turns += top.signum();
                angle = -PI * top.signum();
                continue;
            }
        } else if largest < left {
            left -= largest;
            (angle, rate) = (top, 0.0);
            // On to the other side.
            let back = PI / w;
            if back >= left {
                let [angle, rate] = [angle * (w * left).cos(), -w * angle * (w * left).sin()];
                return [TAU * turns + angle, rate];
            }
            left -= back;
            angle = -angle;
            continue;
        }
        let [angle, rate] = at(left);
        return [TAU * turns + angle, rate];
    }
}

#[test]
fn an_angle_that_passes_its_cut_pulls_the_other_way() {
    // Often, once, by 2 % of a turn within a step that a series could make, and never.
    for (gain, rate) in [(1.7, 6.0), (1.0, 4.0), (1.0, PI + 1e-3), (1.0, PI - 1e-3)] {
        let [heading, turning] = steered(gain, rate, 6.5);
        for (method, tolerance) in methods_at(METHODS, [1e-7, 1e-10]) {
            let start = state(&[0.0], &[rate]);
            let run = run_by(&Boat { gain }, (method, tolerance), start, 6.5);
            let State { q, v, .. } = run.final_state();
            let name = format!("{method} at {tolerance}, gain {gain}, rate {rate}");
            agree(&name, q[0], heading, 1e3 * tolerance);
            agree(&name, v[0], turning, 1e3 * tolerance);
        }
    }
}

/// A needle that turns to a line, with either end: by half the angle that the boat's rudder goes by.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(angle),
    kinetic = der(angle)^2 / 2,
    force(line: angle = -gain * atan(tan(angle))),
)]
struct Needle {
    gain: f64,
}

#[test]
fn a_tangent_that_passes_its_pole_pulls_the_other_way() {
    for (gain, rate) in [(1.7, 6.0), (1.0, 4.0), (1.0, PI + 1e-3), (1.0, PI - 1e-3)] {
        let [heading, turning] = steered(gain, rate, 6.5);
        for (method, tolerance) in methods_at(METHODS, [1e-7, 1e-10]) {
            let start = state(&[0.0], &[rate / 2.0]);
            let run = run_by(&Needle { gain }, (method, tolerance), start, 6.5);
            let State { q, v, .. } = run.final_state();
            let name = format!("{method} at {tolerance}, gain {gain}, rate {rate}");
            agree(&name, 2.0 * q[0], heading, 1e3 * tolerance);
            agree(&name, 2.0 * v[0], turning, 1e3 * tolerance);
        }
    }
}

/// A point slides in a conical funnel without friction, small as seen from above.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = slope * norm((x, y)),
)]
struct Funnel {
    slope: f64,
}

#[test]
fn what_passes_the_middle_of_a_funnel_is_pulled_back() {
    let funnel = Funnel { slope: 1.3 };
    let until = 17.0;
    // Down for √(2/k), and four times that to come back.
    let quarter = (2.0 / funnel.slope).sqrt();
    let phase = (until / quarter) % 4.0;
    let (side, from_middle) = match phase {
        p if p < 1.0 => (1.0, p),
        p if p < 3.0 => (-1.0, p - 2.0),
        p => (1.0, p - 4.0),
    };
    let place = side * (1.0 - from_middle * from_middle);
    for method in METHODS {
        let start = state(&[0.6, 0.8], &[0.0; 2]);
        let run = run_by(&funnel, (method, 1e-9), start, until);
        let State { q, .. } = run.final_state();
        agree(method, q[0], 0.6 * place, 1e-6);
        agree(method, q[1], 0.8 * place, 1e-6);
    }
}

/// A ball on a line through the place that a string begins at, and whose distance is watched: what is declared with numbers, not with parameters.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    contact(string: norm((x - 0.337, y + 0.281)) <= 1.9),
    mark(near: norm((x - 0.337, y + 0.281)) - 0.7),
    mark(other: sqrt((x - 0.613)^2) - 0.1),
)]
struct Tether {}

/// It passes through the middle of the string, where the squares of differences vanish to the last bit, and is caught beyond.
#[test]
fn distances_from_numbers_keep_their_digits() {
    let mut random = Random::new(51);
    for _ in 0..10 {
        let speed = random.between(0.5, 2.0);
        let (sin, cos) = random.between(0.0, 1.2).sin_cos();
        let far = random.between(0.8, 1.4);
        let start = state(
            &[0.337 - far * cos, -0.281 - far * sin],
            &[speed * cos, speed * sin],
        );
        for (method, tolerance) in methods_at(["auto", "dop853", "verner98", "radau5"], TOLERANCES)
        {
            let what = format!("{speed} {cos} {far} by {method} at {tolerance:e}");
            let end = (far + 1.95) / speed;
            let motion = run_by(&Tether {}, (method, tolerance), start.clone(), end);
            let of = |item: usize| {
                let marks = motion.events().iter();
                let marks = marks.filter(move |e| e.subject == Subject::Mark(item));
                marks
                    .map(|mark| mark.time * speed - far)
                    .collect::<Vec<f64>>()
            };
            let side = (0.613 - 0.337) / cos;
            for (times, expected) in [
                (of(0), [-0.7, 0.7]),
                (of(1), [side - 0.1 / cos, side + 0.1 / cos]),
            ] {
                let expected = expected.into_iter().filter(|x| *x < 1.9);
                let expected: Vec<f64> = expected.collect();
                assert_eq!(times.len(), expected.len(), "{what}: {times:?}");
                for (x, y) in times.iter().zip(expected) {
                    agree(&what, *x, y, 1e2 * tolerance);
                }
            }
            let caught = event(&motion, "string", "impact").time * speed - far;
            agree(&what, caught, 1.9, 1e2 * tolerance);
        }
    }
}
