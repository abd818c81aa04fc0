//! A parallelogram linkage that turns through the positions in which its bars are aligned, and is looked at there.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{Random, SINGLE_METHODS, TOLERANCES, agree, methods_at, run_by, words};

/// Two cranks of length 1, joined by a coupler as long as their distance.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, phi, b),
    kinetic = der(a)^2/2 + der(b)^2/2 + inertia/2 * der(phi)^2 + der(cos(a))^2/2 + der(sin(a))^2/2,
    potential = gravity * sin(a),
    constraint(sideways: cos(a) + span * cos(phi) == span + cos(b)),
    constraint(upward: sin(a) + span * sin(phi) == sin(b)),
    mark(aligned: sin(a)),
    stop(turned: a >= end),
)]
struct Parallelogram {
    inertia: f64,
    gravity: f64,
    span: f64,
    end: f64,
}

/// It stays a parallelogram, φ = 0 and a = b, so that 3/2 ȧ² + g sin a stays what it is, also where the run ends with all bars
/// aligned: there the constraints lose rank, and the crossed linkage is one branch away.
#[test]
fn all_methods_pass_aligned_bars_and_stop_there() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(5);
        for k in 0..12 {
            let end = if k % 2 == 0 { 2.0 * PI } else { 9.0 };
            let scene = Parallelogram {
                inertia: random.between(0.1, 2.0),
                gravity: random.between(0.0, 5.0),
                span: random.between(1.2, 3.0),
                end,
            };
            let (a, rate) = (random.between(0.3, 1.5), random.between(4.0, 8.0));
            let energy = |a: f64, rate: f64| 1.5 * rate * rate + scene.gravity * a.sin();
            let start = state(&[a, 0.0, a], &[rate, 0.0, rate]);
            let motion = run_by(&scene, (method, tolerance), start, 20.0);
            let asked = format!("{method} {tolerance:e}, start {k}");
            let [a1, phi, b] = motion.final_state().q[..] else {
                panic!("three coordinates");
            };
            let bound = 1e3 * tolerance;
            agree(&asked, a1, end, bound);
            agree(&asked, phi, 0.0, bound);
            agree(&asked, b, a1, bound);
            let now = energy(a1, motion.final_state().v[0]);
            agree(&asked, now / energy(a, rate), 1.0, bound);
            let marks = motion.events().iter().filter(|e| e.kind.word() == "mark");
            let passed: Vec<f64> = marks.map(|e| e.state.q[0]).collect();
            assert!(
                passed.len() <= 2 && !passed.is_empty(),
                "{asked}: {:?}",
                words(&motion)
            );
            for (place, angle) in passed.iter().zip([PI, 2.0 * PI]) {
                agree(&asked, *place, angle, bound);
            }
        }
    }
}

/// The same without weight, with a stop near the aligned position.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, phi, b),
    kinetic = der(a)^2/2 + der(b)^2/2 + inertia/2 * der(phi)^2 + der(cos(a))^2/2 + der(sin(a))^2/2,
    constraint(sideways: cos(a) + span * cos(phi) == span + cos(b)),
    constraint(upward: sin(a) + span * sin(phi) == sin(b)),
    stop(near: cos(a) <= -1 + short),
)]
struct Near {
    inertia: f64,
    span: f64,
    short: f64,
}

/// Where constraints are about to lose rank steps leap over the position; what is a function of the motion is no polynomial of so low a degree.
#[test]
fn stops_near_aligned_bars_are_where_they_should_be() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(6);
        for k in 0..10 {
            let near = Near {
                inertia: random.between(0.1, 2.0),
                span: random.between(1.2, 3.0),
                short: 10.0_f64.powf(random.between(-9.0, -3.0)),
            };
            let (a, rate) = (random.between(0.3, 2.0), random.between(1.0, 5.0));
            let start = state(&[a, 0.0, a], &[rate, 0.0, rate]);
            let run = run_by(&near, (method, tolerance), start, 10.0);
            let right = ((near.short - 1.0).acos() - a) / rate;
            // The stop is reached at a flat angle.
            let bound = 1e3 * tolerance / (2.0 * near.short).sqrt().min(1.0);
            agree(
                format!("{method} {tolerance:e}, {k}"),
                run.last_time(),
                right,
                bound,
            );
        }
    }
}
