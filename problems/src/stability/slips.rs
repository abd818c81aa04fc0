//! Friction in space, and friction on a constraint.

use super::kit::{closure, distance, event, relative, run, story};
use crate::reference::{integral, root};
use crate::scenes::hard::{CueBall, HoopBead, InclineBlock, RodSleeve, TurningPush};
use core::f64::consts::PI;
use lagrange_program::stability::{Extent, Figure, Surprise};

pub fn incline_block(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = InclineBlock::default();
    let (slope, speed) = (scene.slope, scene.speed);
    let a = scene.gravity * slope.sin();
    let mut figures = Vec::new();
    for n in [1.5, 2.0, 3.0] {
        let block = InclineBlock {
            mu: n * slope.tan(),
            ..scene.clone()
        };
        let time = n * speed / (a * (n * n - 1.0));
        let length = speed * speed / a;
        let across = 0.5 * length * (1.0 / (2.0 * n - 1.0) + 1.0 / (2.0 * n + 1.0));
        let down = 0.25 * length * (1.0 / (2.0 * n - 2.0) - 1.0 / (2.0 * n + 2.0));
        let trajectory = run(&block, InclineBlock::PUSHED, time + 100.0)?;
        story(&trajectory, &["grip sticks"])?;
        let rest = event(&trajectory, "grip", "sticks", 0)?;
        let end = trajectory.final_state();
        let off = distance(rest.state.q[0], across).hypot(distance(rest.state.q[1], down));
        let creep = distance(end.q[0], rest.state.q[0]).hypot(distance(end.q[1], rest.state.q[1]));
        figures.extend([
            Figure::new(
                format!("μ/tan α = {n}: time of rest"),
                relative(rest.time, time),
                1e-10,
            ),
            Figure::new(format!("μ/tan α = {n}: place"), off / across, 1e-10),
            Figure::new(format!("μ/tan α = {n}: creep, m/s"), creep / 100.0, 1e-14),
        ]);
    }
    let even = InclineBlock {
        mu: slope.tan(),
        ..scene
    };
    let trajectory = run(&even, InclineBlock::PUSHED, 10.0)?;
    story(&trajectory, &[])?;
    let v = &trajectory.final_state().v;
    figures.push(Figure::new(
        "μ/tan α = 1: v (1 + cos ψ)",
        relative(v[0].hypot(v[1]) + v[1], speed),
        1e-10,
    ));
    figures.push(Figure::new("ledger", closure(&trajectory)?, 1e-11));
    Ok(figures)
}

pub fn cue_ball(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = CueBall::default();
    let CueBall {
        radius: a,
        gravity,
        mu,
        speed,
        spin,
        follow,
        ..
    } = scene;
    let slip = [speed - a * follow, a * spin];
    let size = slip[0].hypot(slip[1]);
    let time = 2.0 / 7.0 * size / (mu * gravity);
    let rolls = [speed - 2.0 / 7.0 * slip[0], -2.0 / 7.0 * slip[1]];
    let until = time + 2.0;
    let trajectory = run(&scene, CueBall::STRUCK, until)?;
    story(&trajectory, &["grip sticks"])?;
    let sticks = event(&trajectory, "grip", "sticks", 0)?;
    let end = trajectory.final_state();
    let place = |i: usize, first: f64| 0.5 * (first + rolls[i]) * time + rolls[i] * (until - time);
    let place = [place(0, speed), place(1, 0.0)];
    Ok(vec![
        Figure::new("time until it rolls", relative(sticks.time, time), 1e-12),
        Figure::new(
            "direction in which it rolls",
            relative(end.v[1] / end.v[0], rolls[1] / rolls[0]),
            1e-12,
        ),
        Figure::new(
            "place",
            distance(end.q[0], place[0]).hypot(distance(end.q[1], place[1])) / place[0],
            1e-12,
        ),
        Figure::new(
            "slip while it rolls, m/s",
            (end.v[0] - a * end.v[4]).hypot(end.v[1] + a * end.v[3]),
            1e-14,
        ),
        Figure::new("ledger", closure(&trajectory)?, 1e-12),
    ])
}

pub fn turning_push(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let smooth = TurningPush::default();
    let jumps = TurningPush {
        jump: 1.0,
        mu_static: smooth.mu_kinetic + 0.5 / smooth.gravity,
        begin: 0.0,
        ..smooth.clone()
    };
    let mut figures = Vec::new();
    for (name, scene) in [("equal coefficients", smooth), ("unequal", jumps)] {
        let TurningPush {
            begin,
            jump,
            growth,
            turn,
            ..
        } = scene;
        let lasts = 2.0;
        let speed = |t: f64| jump * t + 0.5 * growth * t * t;
        let trajectory = run(&scene, TurningPush::LYING, begin + lasts)?;
        story(&trajectory, &["grip slips"])?;
        let slips = event(&trajectory, "grip", "slips", 0)?;
        let end = trajectory.final_state();
        let (s, c) = (turn * lasts).sin_cos();
        let velocity = [speed(lasts) * c, speed(lasts) * s];
        let place = [
            integral(|t| speed(t) * (turn * t).cos(), 0.0, lasts),
            integral(|t| speed(t) * (turn * t).sin(), 0.0, lasts),
        ];
        let off = |found: &[f64], expected: [f64; 2]| {
            let [x, y] = expected;
            distance(found[0], x).hypot(distance(found[1], y)) / x.hypot(y)
        };
        let along = -slips.forces_after[2].atan2(slips.forces_after[1]);
        figures.extend([
            Figure::new(
                format!("{name}: it slips at, s"),
                distance(slips.time, begin),
                1e-12,
            ),
            Figure::new(
                format!("{name}: direction at first, rad"),
                (along.abs() - PI).abs(),
                1e-9,
            ),
            Figure::new(format!("{name}: velocity"), off(&end.v, velocity), 1e-10),
            Figure::new(format!("{name}: place"), off(&end.q, place), 1e-10),
        ]);
    }
    Ok(figures)
}

pub fn hoop_bead(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = HoopBead::default();
    let HoopBead {
        gravity: g,
        radius: r,
        mu,
        rate,
        ..
    } = scene;
    let square = |sign: f64, from: f64, start: f64, theta: f64| {
        let m = sign * mu;
        let k = 2.0 * g / r / (1.0 + 4.0 * m * m);
        let particular = |x: f64| k * ((1.0 - 2.0 * m * m) * x.cos() - 3.0 * m * x.sin());
        (start - particular(from)) * (-2.0 * m * (theta - from)).exp() + particular(theta)
    };
    let pulled = |theta: f64| square(1.0, 0.0, rate * rate, theta);
    let change = root(|x| pulled(x) + g / r * x.cos(), 0.5 * PI, PI);
    let pushed = |theta: f64| square(-1.0, change, pulled(change), theta);
    let top = root(pushed, change, PI);
    // On its way back the slip is negative: u = −θ obeys the same equation.
    let trajectory = run(&scene, HoopBead::KICKED, 30.0)?;
    let turns = event(&trajectory, "rub", "reverses", 0)?;
    let last = trajectory.final_state();
    let mut sampler = trajectory.sampler();
    let mut worst = 0.0_f64;
    for k in 1..40 {
        let now = sampler.at(turns.time * f64::from(k) / 40.0)?;
        let expected = if now.state.q[1] < change {
            pulled(now.state.q[1])
        } else {
            pushed(now.state.q[1])
        };
        worst = worst.max(distance(now.state.v[1].powi(2), expected) / rate.powi(2));
    }
    Ok(vec![
        Figure::new("θ̇² on the way up", worst, 1e-11),
        Figure::new(
            "where it turns back",
            relative(turns.state.q[1], top),
            1e-11,
        ),
        Figure::new(
            "rests outside the angle of friction, rad",
            (last.q[1].abs() - mu.atan()).max(0.0),
            0.0,
        ),
        Figure::new("moves at rest, rad/s", last.v[1].abs(), 1e-14),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

pub fn rod_sleeve(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = RodSleeve::default();
    let RodSleeve {
        rate: w,
        mu,
        distance: r0,
        speed,
        ..
    } = scene;
    let bend = (mu * mu + 1.0).sqrt();
    let (k1, k2) = (w * (bend - mu), -w * (bend + mu));
    let b = (-speed - k1 * r0) / (k2 - k1);
    let a = r0 - b;
    let turn = ((-b * k2) / (a * k1)).ln() / (k1 - k2);
    let until = 2.0;
    let trajectory = run(&scene, RodSleeve::INWARDS, until)?;
    story(&trajectory, &["rub reverses"])?;
    let turns = event(&trajectory, "rub", "reverses", 0)?;
    let end = trajectory.final_state();
    let r = end.q[0].hypot(end.q[1]);
    Ok(vec![
        Figure::new("time at which it turns", relative(turns.time, turn), 1e-11),
        Figure::new(
            "distance from the axle",
            relative(r, a * (k1 * until).exp() + b * (k2 * until).exp()),
            1e-11,
        ),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}
