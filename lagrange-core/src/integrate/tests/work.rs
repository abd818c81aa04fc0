//! What accuracy costs, pinned: a silent loss of efficiency fails here.

use core::f64::consts::TAU;

use super::problems::{Kepler, Pendulum};
use super::{runge_kutta, taylor};
use crate::integrate::{Method, Tolerance};

/// (steps, rejected, evaluations) on an orbit with e = 0.5 over one turn, and on a pendulum from 2 over one swing.
fn work(method: Method, tolerance: f64) -> [(usize, usize, usize); 2] {
    let tolerance = Tolerance::both(tolerance);
    let mut orbit = Kepler { eccentricity: 0.5 };
    let mut pendulum = Pendulum { start: 2.0 };
    let swing = pendulum.period();
    let runs = match method {
        Method::Taylor => [
            taylor::run(&mut orbit, tolerance, TAU, 1e3),
            taylor::run(&mut pendulum, tolerance, swing, 1e3),
        ],
        method => [
            runge_kutta::run(&mut orbit, method, tolerance, TAU),
            runge_kutta::run(&mut pendulum, method, tolerance, swing),
        ],
    };
    runs.map(|run| (run.steps, run.rejected, run.evaluations))
}

#[test]
fn work_does_not_grow() {
    assert_eq!(work(Method::Taylor, 1e-9), [(16, 0, 16), (14, 0, 14)]);
    assert_eq!(
        work(Method::DormandPrince853, 1e-9),
        [(29, 2, 457), (28, 2, 442)]
    );
    assert_eq!(
        work(Method::DormandPrince54, 1e-9),
        [(115, 0, 690), (110, 0, 660)]
    );
    assert_eq!(work(Method::Verner98, 1e-9), [(25, 4, 560), (21, 0, 420)]);
    assert_eq!(
        work(Method::RungeKutta4 { step: 0.01 }, 1e-9),
        [(629, 0, 2517), (835, 0, 3341)]
    );
    assert_eq!(work(Method::Radau5, 1e-6), [(85, 0, 609), (83, 2, 577)]);
    assert_eq!(
        work(Method::Gauss6 { step: 0.02 }, 1e-9),
        [(315, 0, 3472), (418, 0, 4226)]
    );
}
