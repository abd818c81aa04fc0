//! What lifts off its rest by forces that are rounding or errors as it does. By loose tolerances the root of a force has an error that is larger than what
//! decides on the motion after it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, event, methods_at, run_by, words};

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

/// A bead on top of a smooth sphere, in polar coordinates.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r, theta),
    kinetic = mass/2 * (der(r)^2 + r^2*der(theta)^2),
    potential = mass * gravity * r * cos(theta),
    contact(sphere: r >= radius),
    start(fast: r = radius, der(theta) = sqrt(gravity/radius)),
)]
struct Top {
    mass: f64,
    gravity: f64,
    radius: f64,
}

/// With v² = g R the sphere does not press, to rounding either way, and the bead flies along its parabola from the start on.
#[test]
fn a_bead_that_is_just_fast_enough_leaves_at_once() {
    for mass in [1.0, 0.7] {
        for gravity in [9.81, 10.0, 1.62] {
            for radius in [0.2, 0.3, 0.7, 1.0, 1.1, 1.5, 2.0, 3.0] {
                let scene = Top {
                    mass,
                    gravity,
                    radius,
                };
                for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9, 1e-12]) {
                    let what = format!("{scene:?} by {method} at {tolerance:e}");
                    let until = (radius / gravity).sqrt();
                    let run = run_by(&scene, (method, tolerance), scene.at(Top::FAST), until);
                    assert_eq!(words(&run), ["sphere lost"], "{what}");
                    let (x, y) = (radius, radius / 2.0);
                    let end = run.final_state();
                    agree(&what, end.q[0], x.hypot(y), 100.0 * tolerance);
                    agree(&what, end.q[1], x.atan2(y), 100.0 * tolerance);
                    certified(&what, &run);
                }
            }
        }
    }
}

/// A rocket that loses mass on its stand; at `ignites` its thrust is as large as its weight, to rounding, and from then on larger.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = (full - burns*max(t - ignites, 0)) / 2 * der(y)^2,
    potential = (full - burns*max(t - ignites, 0)) * gravity * y,
    force(thrust: y = if(t <= ignites, 0, burns * (exhaust - der(y)))),
    contact(stand: y >= 0),
    start(ready: y = 0),
)]
struct Rocket {
    full: f64,
    burns: f64,
    exhaust: f64,
    gravity: f64,
    ignites: f64,
}

/// Tsiolkovsky's equation with d(m v)/dt as the declaration has it: v = u ln(m₀/m) − g t.
#[test]
fn a_rocket_whose_thrust_is_its_weight_lifts_at_once() {
    for ignites in [0.0, 0.3] {
        for full in [0.3, 1.0, 3.0, 7.0, 12.0] {
            for burns in [0.1, 0.3, 1.0, 2.0] {
                for gravity in [9.81, 10.0, 1.62] {
                    let exhaust = full * gravity / burns;
                    let scene = Rocket {
                        full,
                        burns,
                        exhaust,
                        gravity,
                        ignites,
                    };
                    for (method, tolerance) in methods_at(["auto", "dop853", "radau5"], [1e-9]) {
                        let what = format!("{scene:?} by {method} at {tolerance:e}");
                        let time = (0.5 * full / burns).min(3.0);
                        let until = ignites + time;
                        let run =
                            run_by(&scene, (method, tolerance), scene.at(Rocket::READY), until);
                        let left = full - burns * time;
                        // u ∫ ln(m₀/m) dt − g t²/2
                        let rises = exhaust * (time - left / burns * (full / left).ln());
                        let rises = rises - gravity * time * time / 2.0;
                        let end = run.final_state().q[0];
                        agree(&what, end, rises, 1e-7 * exhaust);
                        certified(&what, &run);
                    }
                }
            }
        }
    }
}
