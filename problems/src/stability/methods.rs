//! What has to be the same whatever the method, and whatever the tolerance but for the digits that it gives away.

use super::bounces::throws;
use super::constraints::turn;
use super::kit::{TOLERANCE, distance, event, relative, run, run_by};
use crate::scenes::hard::{Parallelogram, StringPendulum, ThrownBall};
use core::f64::consts::TAU;
use lagrange_core::prelude::*;
use lagrange_program::stability::{Extent, Figure, Surprise};

const OTHERS: [Method; 4] = [
    Method::DormandPrince853,
    Method::DormandPrince54,
    Method::Verner98,
    Method::Radau5,
];

/// In flight every step is exact, but not the distance from the pivot: the catch lies on the circle, where free fall meets it.
pub fn catch(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = StringPendulum::default();
    let mut figures = Vec::new();
    for method in OTHERS {
        let trajectory = run_by(&scene, (method, TOLERANCE), StringPendulum::KICKED, 3.0)?;
        let lost = event(&trajectory, "string", "lost", 0)?;
        let hit = event(&trajectory, "string", "impact", 0)?;
        let flight = hit.time - lost.time;
        let [x, y] = [0, 1].map(|i| lost.state.q[i] + lost.state.v[i] * flight);
        let y = y - 0.5 * scene.gravity * flight * flight;
        figures.push(Figure::new(
            format!("{method}: string that is not tight, m"),
            (hit.state.q[0].hypot(hit.state.q[1]) - scene.length).abs(),
            1e-14,
        ));
        figures.push(Figure::new(
            format!("{method}: place in free fall, m"),
            distance(hit.state.q[0], x).max(distance(hit.state.q[1], y)),
            1e-12,
        ));
    }
    Ok(figures)
}

/// Once round through the dead positions, and to a stop of the clock in one of them.
pub fn dead_positions(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = Parallelogram::default();
    let mut figures = Vec::new();
    for method in OTHERS {
        let trajectory = run_by(
            &scene,
            (method, TOLERANCE),
            Parallelogram::SPUN,
            turn(&scene),
        )?;
        let end = trajectory.final_state();
        figures.push(Figure::new(
            format!("{method}: the beam turns, rad"),
            end.q[2].abs(),
            1e-10,
        ));
        figures.push(Figure::new(
            format!("{method}: angle after a turn"),
            end.q[0].atan2(-end.q[1]).abs() / TAU,
            1e-9,
        ));
    }
    Ok(figures)
}

/// At a loose tolerance more of the impacts is left over when they end: the ball must come out as at a tight one.
pub fn coarse_bounces(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let mut figures = Vec::new();
    for (what, scene) in throws() {
        let exact = run(&scene, ThrownBall::THROWN, 3.0)?;
        for tolerance in [1e-6, 1e-9] {
            let asked = (Method::Taylor, tolerance);
            let coarse = run_by(&scene, asked, ThrownBall::THROWN, 3.0)?;
            let [(x, v), (place, rate)] = [&exact, &coarse]
                .map(|run| run.final_state())
                .map(|end| (end.q[0], end.v[0]));
            figures.push(Figure::new(
                format!("{what}, {tolerance:e}: speed"),
                relative(rate, v),
                tolerance,
            ));
            figures.push(Figure::new(
                format!("{what}, {tolerance:e}: place"),
                relative(place, x),
                10.0 * tolerance,
            ));
        }
    }
    Ok(figures)
}
