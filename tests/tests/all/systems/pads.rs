//! A bar that two pads hold: along it one of them may hold what the other does not, and both cones bound that.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, run_by};

/// A bar on two pads at its ends, pulled ever harder at a place `off` its middle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    define(
        e = [cos(phi), sin(phi)],
        a = [x, y] - length/2 * e,
        b = [x, y] + length/2 * e,
        hook = [x, y] + off * e,
    ),
    kinetic = (der(x)^2 + der(y)^2) / 2 + length^2 / 24 * der(phi)^2,
    friction(first: slip = (der(a[0]), der(a[1])), normal = press[0], static = mu, kinetic = 0.8 * mu),
    friction(second: slip = (der(b[0]), der(b[1])), normal = press[1], static = mu, kinetic = 0.8 * mu),
    force(pull: (strength[0] * t, strength[1] * t) at hook),
)]
struct Bar {
    length: f64,
    off: f64,
    press: [f64; 2],
    mu: f64,
    strength: [f64; 2],
}

/// Across the bar each pad has its share by the lever; along it they hold the rest together, √(μ²N₁² − F₁²) + √(μ²N₂² − F₂²) at most. Where the
/// pull is across the bar, only one pad is at its limit, and what it may hold along the bar vanishes as a root does.
#[test]
fn a_bar_slips_when_both_cones_cannot_hold_it() {
    let mut random = Random::new(11);
    for k in 0..40 {
        let tilt = random.between(0.0, 3.0);
        let across = match k % 4 {
            0 => 0.0,
            1 => random.between(-1e-4, 1e-4),
            2 => random.between(-0.1, 0.1),
            _ => random.between(-1.4, 1.4),
        };
        let direction = tilt + core::f64::consts::FRAC_PI_2 + across;
        let bar = Bar {
            length: 1.0,
            off: random.between(-0.5, 0.5),
            press: [random.between(3.0, 9.0), random.between(3.0, 9.0)],
            mu: 0.5,
            strength: [direction.cos(), direction.sin()],
        };
        let holds = |t: f64| {
            let shares = [0.5 - bar.off, 0.5 + bar.off].map(|share| share * across.cos() * t);
            let [a, b] = [0, 1].map(|i| (bar.mu * bar.press[i]).powi(2) - shares[i].powi(2));
            a >= 0.0 && b >= 0.0 && a.sqrt() + b.sqrt() >= (across.sin() * t).abs()
        };
        let (mut held, mut lost) = (0.0, 100.0);
        for _ in 0..100 {
            let middle = 0.5 * (held + lost);
            *if holds(middle) { &mut held } else { &mut lost } = middle;
        }
        for (method, tolerance) in [("taylor", 1e-9), ("dop853", 1e-9), ("radau5", 1e-9)] {
            let start = state(&[0.0, 0.0, tilt], &[0.0; 3]);
            let motion = run_by(&bar, (method, tolerance), start, held + 0.01);
            let slips = motion.events().iter().find(|e| e.kind.word() == "slips");
            let slips = slips.expect("a pad that slips");
            agree(&format!("{method}, bar {k}"), slips.time, held, 1e-8);
        }
    }
}
