//! A puck in a slot of a turntable: slip and the force that presses vanish together.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, methods_at, run_by, words};

/// In polar coordinates; the slot pushes at the distance `radius` from the axle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(r, phi),
    kinetic = mass/2 * (der(r)^2 + (r * der(phi))^2),
    constraint(slot: radius * (phi - rate * t) == 0),
    friction(rub on slot: slip = der(r), static = mu, kinetic = mu),
)]
struct Slot {
    mass: f64,
    radius: f64,
    rate: f64,
    mu: f64,
}

impl Slot {
    /// r after some time, from r̈ = ω² r − (2 μ ω / l) r ṙ, by classical Runge–Kutta steps.
    fn distance(&self, [mut r, mut speed]: [f64; 2], until: f64) -> f64 {
        const STEPS: usize = 400_000;
        let h = until / STEPS as f64;
        let drag = 2.0 * self.mu * self.rate / self.radius;
        let pull = |r: f64, v: f64| r * (self.rate * self.rate - drag * v);
        for _ in 0..STEPS {
            let (r1, v1) = (speed, pull(r, speed));
            let (r2, v2) = (
                speed + 0.5 * h * v1,
                pull(r + 0.5 * h * r1, speed + 0.5 * h * v1),
            );
            let (r3, v3) = (
                speed + 0.5 * h * v2,
                pull(r + 0.5 * h * r2, speed + 0.5 * h * v2),
            );
            let (r4, v4) = (speed + h * v3, pull(r + h * r3, speed + h * v3));
            r += h / 6.0 * (r1 + 2.0 * (r2 + r3) + r4);
            speed += h / 6.0 * (v1 + 2.0 * (v2 + v3) + v4);
        }
        r
    }
}

/// λ = 2 m ω r ṙ / l is nothing where the puck turns, and holding it would need m ω² r: it turns, however rough the slot is.
#[test]
fn a_puck_that_turns_in_a_rough_slot_does_not_stick() {
    for (mass, rate, mu, speed) in [
        (1.0, 0.5, 10.0, 1.0),
        (100.0, 0.05, 30.0, 0.3),
        (0.3, 2.0, 300.0, 1.0),
        (2.0, 0.2, 1e3, 1.0),
        (1e3, 1.0, 5e3, 0.5),
    ] {
        let slot = Slot {
            mass,
            radius: 0.7,
            rate,
            mu,
        };
        let until = 3.0 / rate;
        let expected = slot.distance([0.5, -speed], until);
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9, 1e-12]) {
            let start = state(&[0.5, 0.0], &[-speed, rate]);
            let motion = run_by(&slot, (method, tolerance), start, until);
            let what = format!("{slot:?} by {method} at {tolerance:e}");
            assert_eq!(words(&motion), ["rub reverses"], "{what}");
            let bound = (1e3 * tolerance).max(1e-9);
            agree(&what, motion.final_state().q[0] / expected, 1.0, bound);
            certified(&what, &motion);
        }
    }
}
