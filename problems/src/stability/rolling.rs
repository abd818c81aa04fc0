//! Rolling bodies: conditions on velocities that no condition on positions replaces.

use super::kit::{Vector, closure, cross, distance, relative, run, violation};
use crate::reference::extrapolate;
use crate::scenes::hard::{Rattleback, RollingDisk, Turntable};
use core::f64::consts::TAU;
use lagrange_core::prelude::*;
use lagrange_program::stability::{Extent, Figure, Surprise};

pub fn rolling_disk(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = RollingDisk::default();
    let circle = disk_in_a_circle(&scene)?.into_iter();
    Ok(circle.chain(disk_leaning_over(&scene)?).collect())
}

/// A and C of a disk, per unit of mass R².
const DISK: [f64; 2] = [0.25, 0.5];

/// The lean balances, A ω₂² cot θ = (C + 1) ω₂ ω₃ + (g/R) cos θ.
fn disk_in_a_circle(scene: &RollingDisk) -> Result<[Figure; 2], Surprise> {
    let [thin, axle] = DISK;
    let (r, weight) = (scene.radius, scene.gravity / scene.radius);
    let (theta, turn) = (1.0_f64, -1.5_f64);
    let (s, c) = theta.sin_cos();
    let (w2, w2cot) = (turn * s, turn * c);
    let w3 = (thin * w2 * w2cot - weight * c) / ((axle + 1.0) * w2);
    let circle = RollingDisk {
        start_angle: theta,
        turn,
        spin: w3 - turn * c,
        ..scene.clone()
    };
    let round = TAU / turn.abs();
    let trajectory = run(&circle, RollingDisk::LEANING, 3.0 * round)?;
    let (start, end) = (trajectory.first_state(), trajectory.final_state());
    let back = distance(end.q[0], start.q[0]).hypot(distance(end.q[1], start.q[1]));
    let way = 3.0 * round * r * circle.spin.abs();
    Ok([
        Figure::new("circle: closes after 3 turns", back / way, 1e-9),
        Figure::new("circle: lean, rad", distance(end.q[3], theta), 1e-9),
    ])
}

/// Let go it leans over almost to the floor; Appell's equations for (ω₁, ω₂, ω₃, θ, φ, ψ).
fn disk_leaning_over(scene: &RollingDisk) -> Result<[Figure; 4], Surprise> {
    let [thin, axle] = DISK;
    let weight = scene.gravity / scene.radius;
    let until = 3.0;
    let equations = |_: f64, y: &[f64; 6]| {
        let [w1, w2, w3, theta, ..] = *y;
        let cot = 1.0 / theta.tan();
        [
            (thin * w2 * w2 * cot - (axle + 1.0) * w2 * w3 - weight * theta.cos()) / (thin + 1.0),
            (axle * w3 - thin * w2 * cot) * w1 / thin,
            w1 * w2 / (axle + 1.0),
            w1,
            w2 / theta.sin(),
            w3 - w2 * cot,
        ]
    };
    let (s, c) = scene.start_angle.sin_cos();
    let rates = [0.0, scene.turn * s, scene.spin + scene.turn * c];
    let start = [rates[0], rates[1], rates[2], scene.start_angle, 0.0, 0.0];
    let expected = extrapolate(equations, 0.0, until, start, 4000);
    let trajectory = run(scene, RollingDisk::LEANING, until)?;
    let end = trajectory.final_state();
    let lean = lowest_lean(trajectory.sampler(), until)?;
    let lowest = format!("down to {lean:.2} rad: lean, rad");
    Ok([
        Figure::new(lowest, distance(end.q[3], expected[3]), 1e-9),
        Figure::new("heading", relative(end.q[2], expected[4]), 1e-9),
        Figure::new("turn of the disk", relative(end.q[4], expected[5]), 1e-9),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

fn lowest_lean(mut sampler: Sampler<'_, f64>, until: f64) -> Result<f64, Surprise> {
    let mut lowest = f64::INFINITY;
    for k in 0..=3000 {
        lowest = lowest.min(sampler.at(until * f64::from(k) / 3000.0)?.state.q[3]);
    }
    Ok(lowest)
}

fn combine(a: Vector, factor: f64, b: Vector) -> Vector {
    core::array::from_fn(|k| a[k] + factor * b[k])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Cramer's rule, columns given.
fn solve(columns: [Vector; 3], right: Vector) -> Vector {
    let [x, y, z] = columns;
    let volume = dot(x, cross(y, z));
    [
        dot(right, cross(y, z)) / volume,
        dot(x, cross(right, z)) / volume,
        dot(x, cross(y, right)) / volume,
    ]
}

/// The vertical u and the rates Ω in the body (Kane & Levinson 1982): with r from the mass centre to the contact,
/// I Ω̇ + m r × (Ω̇ × r) = −Ω × I Ω + m r × (g u − Ω × (Ω × r) − Ω × ṙ).
fn rattleback_equations(body: &Rattleback, y: &[f64; 6]) -> [f64; 6] {
    let (u, w) = ([y[0], y[1], y[2]], [y[3], y[4], y[5]]);
    let [i1, i2, i3] = body.inertia;
    let squares = [body.a * body.a, body.b * body.b, body.c * body.c];
    let pressed: Vector = core::array::from_fn(|k| squares[k] * u[k]);
    let support = dot(pressed, u).sqrt();
    let arm = combine([0.0, 0.0, body.height], -1.0 / support, pressed);
    let u_rate = cross(u, w);
    let pressed_rate: Vector = core::array::from_fn(|k| squares[k] * u_rate[k]);
    let support_rate = dot(pressed, u_rate) / support;
    let arm_rate = combine(
        pressed.map(|p| p * support_rate / (support * support)),
        -1.0 / support,
        pressed_rate,
    );
    let inertia = |v: Vector| {
        [
            i1 * v[0] + body.skew * v[1],
            body.skew * v[0] + i2 * v[1],
            i3 * v[2],
        ]
    };
    let matrix = |v: Vector| combine(inertia(v), body.mass, cross(arm, cross(v, arm)));
    let columns = [
        matrix([1.0, 0.0, 0.0]),
        matrix([0.0, 1.0, 0.0]),
        matrix([0.0, 0.0, 1.0]),
    ];
    let inner = combine(
        combine(u.map(|x| body.gravity * x), -1.0, cross(w, cross(w, arm))),
        -1.0,
        cross(w, arm_rate),
    );
    let right = combine(
        cross(arm, inner).map(|x| body.mass * x),
        -1.0,
        cross(w, inertia(w)),
    );
    let w_rate = solve(columns, right);
    [
        u_rate[0], u_rate[1], u_rate[2], w_rate[0], w_rate[1], w_rate[2],
    ]
}

pub fn rattleback(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = Rattleback::default();
    let until = 7.0;
    let trajectory = run(&scene, Rattleback::SPUN, until)?;
    let start = [0.0, 0.0, 1.0, scene.rock, 0.0, scene.spin];
    let expected = extrapolate(
        |_, y| rattleback_equations(&scene, y),
        0.0,
        until,
        start,
        8000,
    );
    let now = trajectory.sampler().at(until)?;
    let (w, u) = (
        now.state.q[3],
        [now.state.q[4], now.state.q[5], now.state.q[6]],
    );
    // The vertical in the body: third row of the rotation.
    let vertical = [
        2.0 * (u[0] * u[2] - w * u[1]),
        2.0 * (u[1] * u[2] + w * u[0]),
        w * w + u[2] * u[2] - u[0] * u[0] - u[1] * u[1],
    ];
    let rates = body_rates(&now);
    let spin = rates[2];
    let worst = (0..3)
        .map(|k| distance(rates[k], expected[3 + k]) / scene.spin.abs())
        .fold(0.0, f64::max);
    let tilt = (0..3)
        .map(|k| distance(vertical[k], expected[k]))
        .fold(0.0, f64::max);
    if spin * scene.spin > 0.0 {
        return Err(Surprise::Missing {
            event: "reversal of the spin".to_owned(),
        });
    }
    Ok(vec![
        Figure::new(
            format!("{:.2} → {spin:.2} rad/s: rates", scene.spin),
            worst,
            1e-9,
        ),
        Figure::new("vertical in the body", tilt, 1e-9),
        Figure::new("height and quaternion, m", violation(&trajectory)?, 1e-12),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

/// Ω = 2 (w u̇ − ẇ u − u × u̇)
fn body_rates(now: &Instant<f64>) -> Vector {
    let (w, u) = (
        now.state.q[3],
        [now.state.q[4], now.state.q[5], now.state.q[6]],
    );
    let (wd, ud) = (
        now.state.v[3],
        [now.state.v[4], now.state.v[5], now.state.v[6]],
    );
    let c = cross(u, ud);
    core::array::from_fn(|k| 2.0 * (w * ud[k] - wd * u[k] - c[k]))
}

pub fn turntable(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = Turntable::default();
    let Turntable {
        rate,
        start_x,
        start_speed,
        ..
    } = scene;
    let until = 20.0;
    let trajectory = run(&scene, Turntable::PUT, until)?;
    // v̇ = (2/7) Ω × v: a circle to the left of the velocity.
    let slow = 2.0 / 7.0 * rate;
    let radius = start_speed / slow;
    let (s, c) = (slow * until).sin_cos();
    let expected = [start_x - radius + radius * c, radius * s];
    let end = trajectory.final_state();
    let off = distance(end.q[0], expected[0]).hypot(distance(end.q[1], expected[1]));
    Ok(vec![
        Figure::new(
            format!("place after {:.1} rounds", slow * until / TAU),
            off / radius,
            1e-10,
        ),
        Figure::new("length of the quaternion", violation(&trajectory)?, 1e-12),
        Figure::new("ledger", closure(&trajectory)?, 1e-10),
    ])
}
