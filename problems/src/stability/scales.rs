//! Scales eight powers of ten apart.

use super::kit::{TOLERANCE, closure, distance, relative, run, run_by};
use crate::reference::extrapolate;
use crate::scenes::hard::{OverdampedOscillator, SpringPendulum, UnequalPendulum};
use lagrange_core::prelude::*;
use lagrange_program::stability::{Extent, Figure, Surprise};

pub fn spring_pendulum(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = SpringPendulum::default();
    let SpringPendulum {
        mass,
        length,
        gravity,
        stiffness,
        start_angle,
    } = scene;
    let until = 0.5;
    let trajectory = run(&scene, SpringPendulum::HELD, until)?;
    // The stretch itself, so that the reference keeps its digits.
    let equations = |_: f64, y: &[f64; 4]| {
        let [stretch, theta, stretch_rate, rate] = *y;
        let r = length + stretch;
        [
            stretch_rate,
            rate,
            r * rate * rate + gravity * theta.cos() - stiffness / mass * stretch,
            -(2.0 * stretch_rate * rate + gravity * theta.sin()) / r,
        ]
    };
    let expected = extrapolate(equations, 0.0, until, [0.0, start_angle, 0.0, 0.0], 5000);
    let end = trajectory.final_state();
    let rings = gravity * mass / stiffness;
    Ok(vec![
        Figure::new("θ", relative(end.q[1], expected[1]), 1e-10),
        Figure::new("θ̇", relative(end.v[1], expected[3]), 1e-9),
        Figure::new(
            format!(
                "stretch after {:.0} rings, of {rings:.0e} m",
                (stiffness / mass).sqrt() * until / core::f64::consts::TAU
            ),
            distance(end.q[0] - length, expected[0]) / rings,
            1e-6,
        ),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

/// The double pendulum by hand, (θ₀, θ₁, θ̇₀, θ̇₁).
fn by_hand(scene: &UnequalPendulum, y: &[f64; 4]) -> [f64; 4] {
    let ([m, n], [l, k], g) = (scene.mass, scene.length, scene.gravity);
    let [a, b, u, v] = *y;
    let (s, c) = (a - b).sin_cos();
    // (m + n) l θ̈₀ + n k c θ̈₁ = −n k s v² − (m + n) g sin a;  l c θ̈₀ + k θ̈₁ = l s u² − g sin b.
    let (p, q) = (
        -n * k * s * v * v - (m + n) * g * a.sin(),
        l * s * u * u - g * b.sin(),
    );
    let first = (p - n * c * q) / (l * (m + n * s * s));
    [u, v, first, (q - l * c * first) / k]
}

pub fn unequal_pendulum(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let above = UnequalPendulum::default();
    let below = UnequalPendulum {
        mass: [1.0, 1e8],
        lower_angle: above.start_angle,
        ..above.clone()
    };
    let mut figures = Vec::new();
    for (what, scene, until, panels) in [
        ("heavy above", &above, 5.0, 2000),
        ("heavy below", &below, 0.5, 20_000),
    ] {
        let trajectory = run(scene, UnequalPendulum::RAISED, until)?;
        let start = [scene.start_angle, scene.lower_angle, 0.0, 0.0];
        let expected = extrapolate(|_, y| by_hand(scene, y), 0.0, until, start, panels);
        let end = trajectory.final_state();
        figures.push(Figure::new(
            format!("{what}: angle of the heavy mass"),
            distance(end.q[0], expected[0]),
            1e-9,
        ));
        figures.push(Figure::new(
            format!("{what}: angle of the light one"),
            distance(end.q[1], expected[1]),
            1e-9,
        ));
        figures.push(Figure::new(
            format!("{what}: ledger"),
            closure(&trajectory)?,
            1e-11,
        ));
    }
    Ok(figures)
}

/// Two decays; at the default method and some tolerances.
pub fn overdamped_oscillator(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = OverdampedOscillator {
        fast: 1e6,
        ..OverdampedOscillator::default()
    };
    let OverdampedOscillator {
        slow,
        fast,
        displacement,
        ..
    } = scene;
    let exact = |t: f64| {
        let [creep, leap] = [slow, fast].map(|rate| (-rate * t).exp());
        let size = displacement / (fast - slow);
        [
            size * (fast * creep - slow * leap),
            size * slow * fast * (leap - creep),
        ]
    };
    let mut figures = Vec::new();
    for tolerance in [1e-6, 1e-9, TOLERANCE] {
        let asked = (Method::Auto, tolerance);
        let trajectory = run_by(&scene, asked, OverdampedOscillator::DRAWN, 10.0)?;
        let mut sampler = trajectory.sampler();
        let mut worst: f64 = 0.0;
        for t in [3e-6, 1e-4, 0.1, 1.0, 3.0] {
            let now = sampler.at(t)?;
            let [x, v] = exact(t);
            worst = worst
                .max(distance(now.state.q[0], x))
                .max(distance(now.state.v[0], v));
        }
        figures.push(Figure::new(
            format!("{tolerance:e}: x, m, and its rate, m/s"),
            worst,
            10.0 * tolerance,
        ));
        // Explicit steps are of some 6/fast.
        let steps = trajectory.work().steps as f64;
        let explicit = 10.0 * fast / 6.0;
        figures.push(Figure::new(
            format!("{tolerance:e}: steps over those of an explicit method"),
            steps / explicit,
            2e-3,
        ));
    }
    Ok(figures)
}
