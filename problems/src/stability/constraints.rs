//! Equations that are redundant, lose their gradient, or have to hold for long.

use super::kit::{TOLERANCE, closure, relative, run, run_by, violation};
use crate::reference::{agm, over_a_turn};
use crate::scenes::hard::{GardenSwing, LongPendulum, Parallelogram, SliderCrank};
use core::f64::consts::TAU;
use lagrange_core::prelude::*;
use lagrange_program::stability::{Extent, Figure, Surprise};

/// Time of a turn: a pendulum that goes round (Abramowitz & Stegun 16.1), T = 4 K(k)/ω₀, k = 2√(g/l)/ω₀.
pub(super) fn turn(scene: &Parallelogram) -> f64 {
    let (rate, k) = (
        scene.speed / scene.length,
        2.0 * (scene.gravity * scene.length).sqrt() / scene.speed,
    );
    TAU / (rate * agm(1.0, ((1.0 - k) * (1.0 + k)).sqrt()))
}

pub fn parallelogram(_: Extent) -> Result<Vec<Figure>, Surprise> {
    const TURNS: f64 = 20.0;
    let scene = Parallelogram::default();
    let trajectory = run(&scene, Parallelogram::SPUN, TURNS * turn(&scene))?;
    let end = trajectory.final_state();
    let angle = end.q[0].atan2(-end.q[1]);
    // Each passage of a dead position costs some 1e-11 of the speed: rounding over the distance at which it is crossed.
    Ok(vec![
        Figure::new(
            format!("angle after {TURNS} turns"),
            angle.abs() / (TURNS * TAU),
            1e-9,
        ),
        Figure::new("the beam turns, rad", end.q[2].abs(), 1e-11),
        Figure::new("length of the cranks, m²", violation(&trajectory)?, 1e-12),
        Figure::new("ledger", closure(&trajectory)?, 1e-9),
    ])
}

pub fn slider_crank(_: Extent) -> Result<Vec<Figure>, Surprise> {
    const TURNS: f64 = 100.0;
    let mut figures = Vec::new();
    let unequal = SliderCrank::default();
    let equal = SliderCrank {
        rod_length: unequal.crank,
        ..unequal.clone()
    };
    for (what, scene) in [("dead centres", &unequal), ("equal lengths", &equal)] {
        let SliderCrank {
            inertia,
            mass,
            crank: r,
            rod_length: l,
            rate,
        } = *scene;
        // x′(θ); where the lengths are equal the root is r cos θ with its sign, which goes through zero.
        let slope = |th: f64| {
            let (s, c) = th.sin_cos();
            if r == l {
                -2.0 * r * s
            } else {
                -r * s - r * r * s * c / (l * l - r * r * s * s).sqrt()
            }
        };
        let turn = over_a_turn(|th| (1.0 + mass / inertia * slope(th).powi(2)).sqrt()) / rate;
        let trajectory = run(scene, SliderCrank::SPUN, TURNS * turn)?;
        let end = trajectory.final_state();
        figures.push(Figure::new(
            format!("{what}: angle after {TURNS} turns"),
            relative(end.q[0], TURNS * TAU),
            if l == r { 1e-9 } else { 1e-11 },
        ));
        figures.push(Figure::new(
            format!("{what}: slider, m"),
            (end.q[1] - r - l).abs(),
            1e-11,
        ));
        figures.push(Figure::new(
            format!("{what}: length of the rod, m²"),
            violation(&trajectory)?,
            1e-12,
        ));
    }
    Ok(figures)
}

/// In pieces, so that no more than a thousand periods are kept in memory.
/// By the default method and another, and at a loose tolerance, where the conditions are left the farthest.
pub fn garden_swing(_: Extent) -> Result<Vec<Figure>, Surprise> {
    const PERIODS: f64 = 5.25;
    let scene = GardenSwing::default();
    let GardenSwing {
        hanger,
        seat,
        inertia,
        length,
        gravity,
        start_angle,
        ..
    } = scene;
    let moment = 2.0 * inertia + (0.5 * hanger + seat) * length * length;
    let rate = ((hanger + seat) * gravity * length / moment).sqrt();
    let period = TAU / (rate * agm(1.0, (0.5 * start_angle).cos()));
    // At the lowest point the phase shows best: ω = 2 ω₀ sin ½θ₀ (Abramowitz & Stegun 17.1).
    let fastest = 2.0 * rate * (0.5 * start_angle).sin();
    let mut figures = Vec::new();
    for (method, tolerance, bound) in [
        (Method::Auto, TOLERANCE, 1e-10),
        (Method::Auto, 1e-6, 1e-5),
        (Method::DormandPrince853, 1e-9, 1e-7),
    ] {
        let asked = (method, tolerance);
        let trajectory = run_by(&scene, asked, GardenSwing::DRAWN, PERIODS * period)?;
        let end = trajectory.final_state();
        let late = 2.0 * end.q[2].atan2(end.q[0]) / fastest;
        figures.push(Figure::new(
            format!("{method}, {tolerance:e}: period"),
            late.abs() / (PERIODS * period),
            bound,
        ));
        figures.push(Figure::new(
            format!("{method}, {tolerance:e}: the seat turns, rad"),
            2.0 * end.q[5..8].iter().map(|x| x.abs()).fold(0.0, f64::max),
            1e-12,
        ));
        figures.push(Figure::new(
            format!("{method}, {tolerance:e}: conditions"),
            violation(&trajectory)?,
            tolerance,
        ));
    }
    Ok(figures)
}

pub fn long_pendulum(extent: Extent) -> Result<Vec<Figure>, Surprise> {
    const PIECE: u32 = 1000;
    let pieces = match extent {
        Extent::Short => 10,
        Extent::Long => 100,
    };
    let scene = LongPendulum::default();
    let LongPendulum {
        mass,
        gravity,
        length,
        start_angle,
    } = scene;
    let period = TAU * (length / gravity).sqrt() / agm(1.0, (0.5 * start_angle).cos());
    let energy = |s: &State<f64>| {
        mass * (0.5 * (s.v[0] * s.v[0] + s.v[1] * s.v[1]) + gravity * (s.q[1] + length))
    };
    let mut state = scene.at(LongPendulum::RAISED);
    let before = energy(&state);
    let (mut worst, mut drift): (f64, f64) = (0.0, 0.0);
    for piece in 0..pieces {
        let length = period * f64::from(PIECE);
        let from = length * f64::from(piece);
        let simulation = Simulation::new(&scene).tolerance(TOLERANCE);
        let trajectory = simulation.run(state, from..from + length)?;
        worst = worst.max(violation(&trajectory)?);
        state = trajectory.final_state().clone();
        drift = drift.max(relative(energy(&state), before));
    }
    let periods = PIECE * pieces;
    // Near the turning point the phase shows in the velocity: v = l θ̈ Δt with θ̈ = −(g/l) sin θ₀.
    let late = state.v[0].hypot(state.v[1]) / (gravity * start_angle.sin());
    Ok(vec![
        Figure::new(
            format!("length of the rod, m², {periods} periods"),
            worst,
            1e-12,
        ),
        Figure::new("energy", drift, 1e-10),
        Figure::new("period", late / (period * f64::from(periods)), 1e-10),
    ])
}
