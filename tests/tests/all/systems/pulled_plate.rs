//! A plate and a sledge on two rough pads that let go at once, or shortly one after the other.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, methods_at, run_by};

/// Pulled across the line of its pads, `off` its middle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    define(
        left = [der(x) - half * sin(turn) * der(turn), der(y) + half * cos(turn) * der(turn)],
        right = [der(x) + half * sin(turn) * der(turn), der(y) - half * cos(turn) * der(turn)],
    ),
    kinetic = (der(x)^2 + der(y)^2) / 2 + inertia/2 * der(turn)^2,
    friction(rubs_left: slip = (left[0], left[1]), limit = limit),
    friction(rubs_right: slip = (right[0], right[1]), limit = limit),
    force(pull: (0, 2 * limit * t) at (x + off * cos(turn), y + off * sin(turn))),
    start(rests),
)]
struct Plate {
    inertia: f64,
    half: f64,
    off: f64,
    limit: f64,
}

/// Both slide along y from t = 1 on: y = F (t − 1)³/3, and the friction has no moment, so that J φ̈ = 2 F t e. Slips are smaller than the errors of
/// velocities for as long as these could choose how the pads rub.
#[test]
fn a_plate_slides_off_both_of_its_pads() {
    for (inertia, half, off, limit) in [
        (0.001, 0.5, 2e-9, 5.0),
        (0.001, 0.3, 4.8e-8, 5.0),
        (0.002, 0.5, 5.9e-9, 5.0),
        (0.05, 1.0, 1e-7, 2.0),
        (0.003, 0.4, -3e-8, 3.0),
    ] {
        let plate = Plate {
            inertia,
            half,
            off,
            limit,
        };
        for pair in methods_at(METHODS, [1e-6, 1e-9]) {
            let what = format!("{plate:?} by {pair:?}");
            let run = run_by(&plate, pair, state(&[0.0; 3], &[0.0; 3]), 1.5);
            let turn = 2.0 * limit * off / inertia * ((1.5_f64.powi(3) - 1.0) / 6.0 - 0.25);
            let [x, y, turned] = run.final_state().q[..] else {
                unreachable!("three coordinates");
            };
            let allowed = 100.0 * pair.1;
            agree(format!("{what}, x"), x, 0.0, allowed);
            agree(format!("{what}, y"), y, limit / 24.0, allowed);
            agree(format!("{what}, turn"), turned, turn, allowed);
        }
    }
}

/// A sledge whose pads are pressed by its weight, pulled in its middle by a force that turns: across the line of its pads when they let go.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z, turn, tip),
    define(
        left = [der(x) - half * sin(turn) * der(turn), der(y) + half * cos(turn) * der(turn)],
        right = [der(x) + half * sin(turn) * der(turn), der(y) - half * cos(turn) * der(turn)],
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2) + mass * half^2 / 6 * der(tip)^2 + mass * (4 * half^2 + 0.36) / 24 * der(turn)^2,
    potential = mass * 9.81 * z,
    contact(front: z + half * tip >= 0),
    contact(rear: z - half * tip >= 0),
    friction(rubs_front on front: slip = (left[0], left[1]), static = mu),
    friction(rubs_rear on rear: slip = (right[0], right[1]), static = mu),
    force(pull: (60 * t * cos(4 * t), 40 * t) at (x, y)),
    start(rests),
)]
struct Sledge {
    mass: f64,
    half: f64,
    mu: f64,
}

/// It moves as a puck does, whose friction was regularised by another program.
#[test]
fn a_sledge_is_pulled_off_by_a_force_that_turns() {
    let sledge = Sledge {
        mass: 4.0,
        half: 0.5,
        mu: 0.4,
    };
    for pair in methods_at(METHODS, [1e-6, 1e-9]) {
        let what = format!("by {pair:?}");
        let run = run_by(&sledge, pair, state(&[0.0; 5], &[0.0; 5]), 2.5);
        let q = &run.final_state().q;
        agree(format!("{what}, x"), q[0], 1.52460562, 1e-4);
        agree(format!("{what}, y"), q[1], 17.47452911, 1e-4);
        agree(format!("{what}, turn"), q[3], 0.0, 1e-5);
    }
}
