//! What a spring and a dashpot move against dry friction creeps to the edge of its dead band, where the friction is exactly at its limit:
//! it slips for ever, and the errors of its slip are no events.

use super::fading::{FIXED, METHODS};
use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, methods_at, run_by, words};

/// Two sleeves in oil, with a dashpot between them.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = stiffness/2 * (x^2 + y^2),
    dissipation(oil: damping/2 * (der(x)^2 + der(y)^2)),
    dissipation(coupler: between/2 * (der(x) - der(y))^2),
    friction(left: slip = der(x), limit = dry),
    friction(right: slip = der(y), limit = dry),
)]
struct Sleeves {
    stiffness: f64,
    damping: f64,
    between: f64,
    dry: f64,
}

/// With the left one going back and the right one forth, p = x + y and d = x − y − 2 F/k move by themselves.
#[test]
fn what_creeps_to_the_edge_of_its_dead_band_does_not_stick() {
    let scene = Sleeves {
        stiffness: 12.0,
        damping: 9.0,
        between: 4.0,
        dry: 2.0,
    };
    let (x, y, until): (f64, f64, f64) = (1.0, -0.8, 50.0);
    let edge = 2.0 * scene.dry / scene.stiffness;
    // From rest at 1, of u″ + c u′ + k u = 0.
    let creeps = |damping: f64| {
        let half = 0.5 * damping;
        let root = (half * half - scene.stiffness).sqrt();
        let (slow, fast) = (root - half, -root - half);
        (fast * (slow * until).exp() - slow * (fast * until).exp()) / (fast - slow)
    };
    let p = (x + y) * creeps(scene.damping);
    let d = edge + (x - y - edge) * creeps(scene.damping + 2.0 * scene.between);
    for ((method, times), tolerance) in methods_at(METHODS, [1e-4, 1e-6, 1e-9, 1e-12]) {
        let start = state(&[x, y], &[0.0; 2]);
        let run = run_by(&scene, (method, tolerance), start, until);
        let what = format!("{method} at {tolerance:e}");
        assert_eq!(words(&run), ["left slips", "right slips"], "{what}");
        let mode = run.final_mode();
        assert!(mode.slips(Sleeves::LEFT) && mode.slips(Sleeves::RIGHT));
        let (end, allowed) = (run.final_state(), (times * tolerance).max(FIXED));
        agree(&what, end.q(Sleeves::X), 0.5 * (p + d), allowed);
        agree(&what, end.q(Sleeves::Y), 0.5 * (p - d), allowed);
    }
}
