//! A motion that no coefficient of its series announces.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::agree;

/// A mass whose push begins like t³⁶: up to the largest order the series at t = 0 is that of a mass left alone.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(late: x = (t/scale)^36),
)]
struct Late {
    scale: f64,
}

/// x = v t + s² (t/s)³⁸/(37·38)
#[test]
fn a_step_is_checked_at_its_end_and_not_by_its_coefficients() {
    let scene = Late { scale: 1.5 };
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let motion = Simulation::new(&scene)
            .tolerance(tolerance)
            .run(state(&[0.0], &[0.25]), 0.0..2.0)
            .expect("a run");
        let part = 2.0_f64 / 1.5;
        let x = 0.5 + 2.25 * part.powi(38) / (37.0 * 38.0);
        let v = 0.25 + 1.5 * part.powi(37) / 37.0;
        let end = motion.final_state();
        agree("x", end.q[0], x, 10.0 * tolerance);
        agree("v", end.v[0], v, 10.0 * tolerance);
    }
}
