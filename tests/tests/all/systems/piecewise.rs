//! Forces with `abs`, `max`, `sign` and `if`: their switching is located.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, run};

/// A damped oscillator between two stops made with `max`.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = stiffness/2 * max(abs(x) - clearance, 0)^2,
    dissipation(oil: damping/2 * der(x)^2),
)]
struct Stops {
    mass: f64,
    stiffness: f64,
    clearance: f64,
    damping: f64,
}

#[test]
fn piecewise_forces_are_located() {
    let scene = Stops {
        mass: 1.0,
        stiffness: 400.0,
        clearance: 0.5,
        damping: 0.0,
    };
    let trajectory = run(&scene, state(&[0.0], &[2.0]), 3.0);
    // Free for 0.5/2, half a period π/ω in the stop, free for 1/2, …
    let (free, half) = (0.25, PI / 20.0);
    let times: Vec<f64> = trajectory
        .events()
        .iter()
        .filter(|e| e.kind == EventKind::Branches)
        .map(|e| e.time)
        .collect();
    for expected in [
        free,
        free + half,
        3.0 * free + half,
        3.0 * free + 2.0 * half,
    ] {
        assert!(
            times.iter().any(|t| (t - expected).abs() < 1e-11),
            "{expected} not in {times:?}"
        );
    }
    assert!(closure(&trajectory) < 1e-12);
    // With oil: x and v decay as e^{−ct/m} in the gap.
    let scene = Stops {
        damping: 1.5,
        ..scene
    };
    let trajectory = run(&scene, state(&[0.0], &[0.3]), 2.0);
    agree(
        "v",
        trajectory.final_state().v[0],
        0.3 * (-3.0_f64).exp(),
        1e-12,
    );
    let ledger = trajectory.ledger().expect("sampled");
    agree(
        "oil",
        ledger.work[0].work,
        -0.045 * (1.0 - (-6.0_f64).exp()),
        1e-12,
    );
}
