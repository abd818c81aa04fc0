//! A body on several feet that comes to rest for a moment: where all can stick, all do, however soon its push is too much for them.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, run_by, times};

/// A block on four feet, braked by a push that grows until it drives it back.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z, yaw),
    kinetic = mass/2*(der(x)^2 + der(y)^2 + der(z)^2) + inertia/2*der(yaw)^2,
    potential = mass*9.81*z,
    define(
        side = [[long, wide], [-long, wide], [-long, -wide], [long, -wide]],
        ahead[k in 0..4] = side[k][0]*cos(yaw) - side[k][1]*sin(yaw),
        aside[k in 0..4] = side[k][0]*sin(yaw) + side[k][1]*cos(yaw),
    ),
    contact(floor: z >= 0),
    friction(foot[k in 0..4]: slip = (der(x + ahead[k]), der(y + aside[k])), normal = mass*9.81/4, static = mu),
    force(push: x = -mu*mass*9.81*(1 + growth*(t - full))),
)]
struct Block {
    mass: f64,
    inertia: f64,
    long: f64,
    wide: f64,
    mu: f64,
    growth: f64,
    full: f64,
}

#[test]
fn four_feet_stick_for_as_long_as_they_can() {
    for (case, rest) in [(0, 1e-2), (1, 1e-3), (2, 1e-4)] {
        let scene = Block {
            mass: [0.7, 2.0, 1.3][case],
            inertia: 0.03,
            long: 0.2,
            wide: 0.15,
            mu: [0.35, 0.3, 0.5][case],
            growth: 5.0,
            full: 0.2,
        };
        let Block {
            mu, growth, full, ..
        } = scene;
        // Friction and the push brake it together: a = −μ g (2 + growth (t − full)).
        let stops = full - rest;
        let brakes = mu * 9.81 * (2.0 * stops + growth * (stops * stops / 2.0 - full * stops));
        let start = state(&[0.0; 4], &[brakes, 0.0, 0.0, 0.0]);
        // It leaves when the push alone is as much as friction, and then gains on it.
        let until = 0.25;
        let speed = -mu * 9.81 * growth * (until - full).powi(2) / 2.0;
        for method in METHODS {
            for tolerance in [1e-6, 1e-9, 1e-12] {
                let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
                let run = run_by(&scene, (method, tolerance), start.clone(), until);
                for foot in ["foot[0]", "foot[1]", "foot[2]", "foot[3]"] {
                    let [sticks] = times(&run, foot, "sticks")[..] else {
                        panic!("{what}: {foot}")
                    };
                    let [slips] = times(&run, foot, "slips")[..] else {
                        panic!("{what}: {foot}")
                    };
                    agree(&what, sticks, stops, 100.0 * tolerance);
                    agree(&what, slips, full, 100.0 * tolerance);
                }
                agree(&what, run.final_state().v[0], speed, 100.0 * tolerance);
                certified(&what, &run);
            }
        }
    }
}
