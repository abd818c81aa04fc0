//! A puck on a turntable: carried along, left behind, caught. Where slip begins its direction is found with the motion.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, all_agree, closure, event, run, run_by, words};

/// A puck on a level table that turns at ω = speed + acceleration t.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    define(omega = speed + acceleration * t),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    contact(table: z >= 0),
    friction(grip on table: slip = (der(x) + omega * y, der(y) - omega * x), static = mu_static, kinetic = mu_kinetic),
)]
struct Puck {
    mass: f64,
    gravity: f64,
    speed: f64,
    acceleration: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

fn puck(high: f64, low: f64) -> Puck {
    Puck {
        mass: 0.3,
        gravity: 9.81,
        speed: 0.0,
        acceleration: 0.4,
        mu_static: high,
        mu_kinetic: low,
    }
}

/// It slips when r √(ω⁴ + ω̇²) = μs g.
#[test]
fn a_puck_slips_off_a_table_that_speeds_up() {
    let r = 0.5;
    for (high, low) in [
        (0.3, 0.25),
        (0.3, 0.3),
        (0.3, 0.05),
        (0.3, 0.2999),
        (0.3, 0.29999999),
    ] {
        let scene = puck(high, low);
        let trajectory = run(&scene, state(&[r, 0.0, 0.0], &[0.0; 3]), 8.0);
        assert_eq!(words(&trajectory), ["grip slips"]);
        let rate = ((high * 9.81 / r).powi(2) - 0.16).powf(0.25);
        let event = &trajectory.events()[0];
        agree("slips at", event.time, rate / 0.4, 1e-12);
        let turned = 0.2 * event.time * event.time;
        let place = [r * turned.cos(), r * turned.sin()];
        all_agree("where", &event.state.q[..2], &place, 1e-12);
        // The direction of the friction that slip begins with is that of the friction before, and its size μk N.
        let before = [event.forces[1], event.forces[2]];
        let after = [event.forces_after[1], event.forces_after[2]];
        let share = low / high;
        all_agree("friction", &after, &before.map(|f| share * f), 1e-10);
        // The ledger takes the direction from the slip, the motion took it from the series.
        assert!(closure(&trajectory) < 1e-11, "{}", closure(&trajectory));
        let end = trajectory.final_state();
        for (method, bound) in [
            ("dopri5", 1e-8),
            ("dop853", 1e-9),
            ("verner98", 1e-9),
            ("radau5", 1e-8),
            ("gauss6:1e-2", 1e-8),
            ("rk4:1e-3", 1e-8),
        ] {
            let start = state(&[r, 0.0, 0.0], &[0.0; 3]);
            let other = run_by(&scene, (method, 1e-11), start, 8.0);
            all_agree(method, &end.q, &other.final_state().q, bound);
        }
    }
}

/// Carried along for ever, or left behind: on a table that turns steadily a resting puck stays if ω² r < μ g.
#[test]
fn a_puck_stays_or_is_left_behind() {
    let steady = |speed: f64| Puck {
        speed,
        acceleration: 0.0,
        ..puck(0.3, 0.3)
    };
    let r = 0.5;
    let trajectory = run(
        &steady(2.0),
        state(&[r, 0.0, 0.0], &[0.0, 2.0 * r, 0.0]),
        20.0,
    );
    assert!(words(&trajectory).is_empty());
    let place = [r * 40.0_f64.cos(), r * 40.0_f64.sin(), 0.0];
    all_agree("where", &trajectory.final_state().q, &place, 1e-11);
    let trajectory = run(
        &steady(3.0),
        state(&[r, 0.0, 0.0], &[0.0, 3.0 * r, 0.0]),
        5.0,
    );
    assert_eq!(words(&trajectory), ["grip slips"]);
    assert!(closure(&trajectory) < 1e-11);
    // Laid down at rest it slips against its place's velocity; friction then drives it outwards and around.
    let trajectory = run(&steady(1.0), state(&[r, 0.0, 0.0], &[0.0; 3]), 5.0);
    assert_eq!(words(&trajectory), ["grip sticks"]);
    let ledger = trajectory.ledger().expect("recorded");
    assert!(ledger.closure.abs() < 2e-12, "{}", ledger.closure);
    let event = event(&trajectory, "grip", "sticks");
    let distance = event.state.q[0].hypot(event.state.q[1]);
    let end = trajectory.final_state();
    agree("distance", end.q[0].hypot(end.q[1]), distance, 1e-12);
    agree("carried", end.v[0].hypot(end.v[1]), distance, 1e-12);
}
