//! Long runs: rounding errors stay rounding errors.

use core::f64::consts::TAU;

use super::problems::{Kepler, Pendulum, Problem};
use super::{runge_kutta, taylor};
use crate::integrate::{Method, Tolerance};

#[test]
fn energy_of_an_orbit_after_a_hundred_turns() {
    let mut orbit = Kepler { eccentricity: 0.5 };
    let end = taylor::run(&mut orbit, Tolerance::both(1e-16), 100.0 * TAU, 1e3);
    let drift = (Kepler::energy(&end.q, &end.v) + 0.5).abs();
    // √steps · 2⁻⁵³ with a factor of ten for the conditioning near the pericentre.
    assert!(
        drift < 10.0 * (end.steps as f64).sqrt() * 1.1e-16,
        "{drift:e} after {} steps",
        end.steps
    );
    let end = runge_kutta::run(
        &mut orbit,
        Method::Verner98,
        Tolerance::both(1e-14),
        100.0 * TAU,
    );
    let drift = (Kepler::energy(&end.q, &end.v) + 0.5).abs();
    assert!(drift < 1e-11, "{drift:e} after {} steps", end.steps);
}

/// Rounding is a random walk, so that the error of a single swing is luck: the median of several starts counts.
#[test]
fn a_pendulum_after_two_hundred_swings() {
    let mut errors: Vec<f64> = (0..25)
        .map(|k| {
            let mut pendulum = Pendulum {
                start: 2.0 + 1e-3 * k as f64,
            };
            let until = 200.0 * pendulum.period();
            let end = taylor::run(&mut pendulum, Tolerance::both(1e-16), until, 1e3);
            end.error(pendulum.solution(until))
        })
        .collect();
    errors.sort_by(f64::total_cmp);
    let median = errors[errors.len() / 2];
    assert!(median < 1e-11, "{median:e}");
}
