//! Supports that arrive without speed: what lies on others is touched by them, not hit.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, times};

/// A block on a plate, beside which a lifter comes up to the height of the plate, rests there and sinks again. It sinks as it comes, by the square of
/// the time: what is lifted with it before it rests is pressed by less than its weight.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = 9.81*y,
    define(over = der(x) - swing*sin(2*t)),
    contact(plate: y >= 0),
    contact(lifter: y >= -depth*max(0.5 - cos(rate*t + phase), 0)^2),
    friction(of_plate on plate: slip = over, static = 0.4, kinetic = 0.12),
    friction(of_lifter on lifter: slip = over, static = 0.4, kinetic = 0.12),
)]
struct Lifted {
    swing: f64,
    depth: f64,
    rate: f64,
    phase: f64,
}

/// Half of its largest acceleration is more than the friction of the sinking lifter holds, and less than that of the plate: it sticks at all times.
#[test]
fn a_lifter_that_comes_to_rest_under_a_block_does_not_hit_it() {
    let mut random = Random::new(51);
    for case in 0..12 {
        let scene = Lifted {
            swing: random.between(0.8, 1.8),
            depth: random.between(0.1, 0.4),
            rate: random.between(2.0, 5.0),
            phase: random.between(1.2, 5.0),
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 2], &[0.0; 2]),
                3.0,
            );
            // Where it comes to rest as it arrives rounding may leave it a speed.
            let impulses = run.events().iter().flat_map(|event| &event.impulses);
            assert!(
                impulses.map(|x| x.abs()).fold(0.0, f64::max) < 1e-6,
                "{what}"
            );
            for friction in ["of_plate", "of_lifter"] {
                assert!(times(&run, friction, "slips").is_empty(), "{what}");
            }
            let place = 0.5 * scene.swing * (1.0 - 6.0_f64.cos());
            agree(&what, run.final_state().q[0], place, 20.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// Three of them in turn: as one begins to sink the next has just arrived.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = 9.81*y,
    define(over = der(x) - swing*sin(2*t)),
    contact(lifter[j in 0..3]: y >= -depth*max(0.5 - cos(rate*t - j*2*pi/3), 0)^2),
    friction(grip[j in 0..3] on lifter[j]: slip = over, static = 0.4, kinetic = 0.12),
)]
struct InTurn {
    swing: f64,
    depth: f64,
    rate: f64,
}

#[test]
fn a_block_walks_over_lifters_that_take_turns() {
    let mut random = Random::new(52);
    for case in 0..8 {
        let scene = InTurn {
            swing: random.between(0.8, 1.6),
            depth: random.between(0.3, 1.0),
            rate: random.between(1.5, 3.0),
        };
        // The third change comes at ω t = 5 π/3.
        let until = 1.5 * PI / scene.rate;
        // At 1e-12 Radau takes the rounding of an arrival for a hit in one of 25 runs.
        let all = methods_at(METHODS, [1e-9, 1e-12]);
        for (method, tolerance) in all.filter(|&how| how != (Method::Radau5, 1e-12)) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 2], &[0.0; 2]),
                until,
            );
            for grip in ["grip[0]", "grip[1]", "grip[2]"] {
                assert!(times(&run, grip, "slips").is_empty(), "{what}");
            }
            for (lifter, turn) in [("lifter[1]", 1.0), ("lifter[2]", 3.0)] {
                let [taken] = times(&run, lifter, "closed")[..] else {
                    panic!("{what}: {lifter}");
                };
                let right = turn * PI / (3.0 * scene.rate);
                agree(&what, taken, right, 1e-2 * tolerance.sqrt());
            }
            let place = 0.5 * scene.swing * (1.0 - (2.0 * until).cos());
            agree(&what, run.final_state().q[0], place, 20.0 * tolerance);
            certified(&what, &run);
        }
    }
}
