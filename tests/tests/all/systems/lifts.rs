//! An arm on a shaft that is driven lifts off its rest: by loose tolerances the root of the force has an error that is larger than what
//! decides on the motion after it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, event, run_by};

/// A governor with one arm, whose lift a dashpot damps.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(alpha, psi),
    kinetic = rotor/2 * der(psi)^2 + mass/2 * length^2 * (der(alpha)^2 + sin(alpha)^2 * der(psi)^2),
    potential = -mass * gravity * length * cos(alpha),
    force(motor: psi = torque),
    dissipation(load: loss/2 * der(psi)^2),
    dissipation(dashpot: damping/2 * der(alpha)^2),
    contact(rest: alpha >= low, restitution = 0.3),
)]
struct Arm {
    rotor: f64,
    mass: f64,
    length: f64,
    gravity: f64,
    torque: f64,
    loss: f64,
    damping: f64,
    low: f64,
}

/// While the arm rests the shaft turns with ω = T/c (1 − exp(−c t/J)), and the arm lifts where ω² = g/(l cos α).
#[test]
fn an_arm_lifts_by_every_tolerance() {
    for torque in [0.4, 0.46, 0.52, 0.6] {
        let arm = Arm {
            rotor: 0.02,
            mass: 1.0,
            length: 0.3,
            gravity: 9.81,
            torque,
            loss: 0.06,
            damping: 10.0,
            low: 0.2,
        };
        let inertia = arm.rotor + arm.mass * (arm.length * arm.low.sin()).powi(2);
        let speed = (arm.gravity / (arm.length * arm.low.cos())).sqrt();
        let time = -inertia / arm.loss * (-speed * arm.loss / torque).ln_1p();
        for tolerance in [1e-4, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 1e-9] {
            let start = state(&[arm.low, 0.0], &[0.0; 2]);
            let run = run_by(&arm, ("taylor", tolerance), start, 0.8);
            let lifts = event(&run, "rest", "lost");
            let asked = format!("{torque} N m by {tolerance:e}");
            agree(&asked, lifts.time, time, 10.0 * tolerance);
        }
    }
}
