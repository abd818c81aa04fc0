//! A crate slides on a floor with a load on a chute in it: the friction moves the load, and the load the normal force. Close to its rest,
//! where its last Taylor coefficients are beyond all numbers, the direction of the slip is known to a few digits only, and so are both
//! forces.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, run_by, words};

/// A crate at x, y, z; the load is s up its chute, on a spring.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z, s),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2)
        + load/2 * ((der(x) + cos(slope) * der(s))^2 + der(y)^2 + (der(z) + sin(slope) * der(s))^2),
    potential = gravity * ((mass + load) * z + load * sin(slope) * s) + stiffness/2 * s^2,
    contact(floor: z >= 0),
    friction(grip on floor: slip = (der(x), der(y)), static = mu),
)]
struct Crate {
    mass: f64,
    load: f64,
    stiffness: f64,
    slope: f64,
    gravity: f64,
    mu: f64,
}

/// Instant and place of rest by extrapolation in dt = |v| dτ with 30 digits (Bulirsch and Stoer), where the end is at infinity.
#[test]
fn a_crate_comes_to_rest_at_the_tightest_tolerances() {
    let scene = Crate {
        mass: 2.0,
        load: 1.0,
        stiffness: 40.0,
        slope: 0.9,
        gravity: 9.81,
        mu: 0.5,
    };
    for tolerance in [1e-16, 3e-16, 3e-15, 1e-14, 1e-12] {
        // How long the run is to last decides on the resolution of time.
        for until in [0.6, 5.0] {
            let start = state(&[0.0; 4], &[2.0, -1.5, 0.0, 0.0]);
            let run = run_by(&scene, ("taylor", tolerance), start, until);
            let what = format!("{tolerance:e} for {until} s");
            assert_eq!(words(&run), ["grip sticks"], "{what}");
            let rest = &run.events()[0];
            let allowed = (10.0 * tolerance).max(3e-15);
            agree(&what, rest.time, 0.496_485_743_158_075_6, allowed);
            agree(&what, rest.q(Crate::X), 0.580_238_077_895_226_1, allowed);
            agree(&what, rest.q(Crate::Y), -0.413_083_303_348_041_8, allowed);
        }
    }
}
