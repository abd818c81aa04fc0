//! Gaps without a gradient where they are zero: a floor exactly as low as a pendulum hangs.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, all_agree, methods_at, run_by};

/// Two rods that hang; the lower one cannot swing behind the upper one.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, b),
    kinetic = (upper * der(a))^2 / 2 + mass/2 * (der(upper * sin(a) + lower * sin(b))^2 + der(upper * cos(a) + lower * cos(b))^2),
    potential = -10 * upper * cos(a) - mass * 10 * (upper * cos(a) + lower * cos(b)),
    contact(knee: b - a >= 0),
    contact(floor: upper + lower - upper * cos(a) - lower * cos(b) >= 0),
)]
struct Leg {
    upper: f64,
    lower: f64,
    mass: f64,
}

/// Straight down both rods touch the floor at the instant at which the lower one swings ahead: the floor changes nothing.
#[test]
fn a_floor_as_low_as_a_leg_reaches_is_grazed() {
    for (upper, lower, mass, from) in [
        (1.0, 0.5, 1.0, -0.5),
        (0.5, 0.659, 2.0, -0.773),
        (0.3, 0.5, 2.0, -0.2),
        (0.5, 0.3, 2.0, -0.757),
        (1.7, 0.4, 0.6, -0.35),
    ] {
        let leg = Leg { upper, lower, mass };
        for (method, tolerance) in methods_at(METHODS, [1e-9]) {
            let start = || state(&[from; 2], &[0.0; 2]);
            let simulation = Simulation::new(&leg).method(method).tolerance(tolerance);
            let free = simulation.effects(Effects::all().without(Leg::FLOOR));
            let free = free.run(start(), 0.0..1.0).expect("a run");
            let run = run_by(&leg, (method, tolerance), start(), 1.0);
            let what = format!("{leg:?} by {method}");
            all_agree(what, &run.final_state().q, &free.final_state().q, 1e-7);
        }
    }
}
