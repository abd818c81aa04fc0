//! A bar that two pads hold: what each of them holds along it is open.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, run_by, words};

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

/// However it is pulled, it holds at first: the accelerations that its forces keep at zero leave rounding, which grows with the time looked at.
#[test]
fn a_bar_holds_under_a_load_that_grows_from_nothing() {
    let mut random = Random::new(11);
    for k in 0..40 {
        let tilt = random.between(0.0, 3.0);
        let direction = random.between(0.0, 6.0);
        let bar = Bar {
            length: 1.0,
            off: random.between(-0.5, 0.5),
            press: [random.between(3.0, 9.0), random.between(3.0, 9.0)],
            mu: 0.5,
            strength: [direction.cos(), direction.sin()],
        };
        for (method, tolerance) in [("taylor", 1e-6), ("dop853", 1e-9), ("radau5", 1e-12)] {
            let start = state(&[0.0, 0.0, tilt], &[0.0; 3]);
            let motion = run_by(&bar, (method, tolerance), start, 1.4);
            assert!(
                words(&motion).is_empty(),
                "{method}, bar {k}: {:?}",
                words(&motion)
            );
            // One pad alone holds 1.5 N.
            let still = motion.final_state().v.iter().all(|v| v.abs() < 1e-14);
            assert!(still, "{method}, bar {k}: {:?}", motion.final_state().v);
        }
    }
}
