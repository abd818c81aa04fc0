//! Bodies in a row that a driven one pushes: all forces between them vanish at one instant, and in the free flight that follows what
//! moves fast is the wall only, of which the motion knows nothing.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{Random, TOLERANCES, agree, event, methods_at, root, run_by, words};

/// Three flywheels on overrunning clutches, one behind the other, behind a shaft that swings; each is slowed down by a weight on a drum.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(wheel[3]),
    kinetic = sum(k in 0..3: (1 + k)/2 * der(wheel[k])^2),
    potential = load * sum(k in 0..3: (1 + k) * wheel[k]),
    contact(shaft: wheel[0] >= swing * sin(rate * t), restitution = rebound),
    contact(clutch[k in 0..2]: wheel[k + 1] >= wheel[k], restitution = rebound),
)]
struct Flywheels {
    load: f64,
    swing: f64,
    rate: f64,
    rebound: f64,
}

impl Flywheels {
    /// When the shaft slows down by more than the load does: A ω² sin ωt = a.
    fn leaves(&self) -> f64 {
        (self.load / (self.swing * self.rate.powi(2))).asin() / self.rate
    }

    /// When the flight from there meets the shaft again, by bisection between the top of the shaft's swing and its next one.
    fn meets(&self) -> f64 {
        let start = self.leaves();
        let (sin, cos) = (self.rate * start).sin_cos();
        let gap = |t: f64| {
            let s = t - start;
            let flight = self.swing * (sin + self.rate * cos * s) - 0.5 * self.load * s * s;
            flight - self.swing * (self.rate * t).sin()
        };
        root(gap, 0.5 * PI / self.rate, 2.5 * PI / self.rate)
    }
}

/// They leave the shaft, and are met by it, when one flywheel alone would.
#[test]
fn they_leave_together_and_come_back_together() {
    let mut random = Random::new(5);
    for _ in 0..12 {
        let rate = random.between(20.0, 300.0);
        let load = 9.81;
        let swing = random.between(1.2, 2.5) * load / (rate * rate);
        let wheels = Flywheels {
            load,
            swing,
            rate,
            rebound: 0.0,
        };
        for (method, tolerance) in methods_at(["auto", "dop853", "verner98"], TOLERANCES) {
            let asked = format!("{wheels:?} {method} {tolerance:e}");
            let start = state(&[0.0; 3], &[swing * rate; 3]);
            let motion = run_by(&wheels, (method, tolerance), start, 2.6 * PI / rate);
            let allowed = 100.0 * tolerance;
            agree(
                &asked,
                rate * event(&motion, "shaft", "lost").time,
                rate * wheels.leaves(),
                allowed,
            );
            agree(
                &asked,
                rate * event(&motion, "shaft", "impact").time,
                rate * wheels.meets(),
                allowed,
            );
        }
    }
}

/// The same without weights, from rest: they leave the shaft where it is fastest, and everything that drives vanishes there.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(wheel[3]),
    kinetic = sum(k in 0..3: (1 + k)/2 * der(wheel[k])^2),
    contact(shaft: wheel[0] >= swing * (1 - cos(rate * t))),
    contact(clutch[k in 0..2]: wheel[k + 1] >= wheel[k]),
)]
struct Freewheels {
    swing: f64,
    rate: f64,
}

#[test]
fn nothing_is_left_of_what_drives() {
    let mut random = Random::new(11);
    for _ in 0..12 {
        let rate = random.between(20.0, 300.0);
        let swing = random.between(0.5, 50.0) / (rate * rate);
        let wheels = Freewheels { swing, rate };
        for (method, tolerance) in methods_at(["auto", "dop853", "verner98"], TOLERANCES) {
            let asked = format!("{wheels:?} {method} {tolerance:e}");
            let motion = run_by(
                &wheels,
                (method, tolerance),
                state(&[0.0; 3], &[0.0; 3]),
                1.0,
            );
            let lost = event(&motion, "shaft", "lost").time;
            agree(&asked, rate * lost, 0.5 * PI, 100.0 * tolerance);
            let closed = words(&motion);
            assert!(
                !closed.iter().any(|word| word.contains("impact")),
                "{asked}: {closed:?}"
            );
            let end = swing * (1.0 + rate * (1.0 - 0.5 * PI / rate));
            for &angle in &motion.final_state().q {
                agree(&asked, angle, end, 1e4 * tolerance);
            }
        }
    }
}
