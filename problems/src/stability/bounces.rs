//! Impacts: one after the other, at once, infinitely many.

use super::kit::{closure, distance, event, relative, run, story, violation};
use crate::reference::{integral, root};
use crate::scenes::hard::{
    BouncingBall, Cradle, FiveBallCradle, RockingBlock, StringPendulum, ThrownBall,
};
use core::f64::consts::FRAC_PI_2;
use lagrange_core::prelude::EventKind;
use lagrange_program::stability::{Extent, Figure, Surprise};

pub fn bouncing_ball(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let mut figures = Vec::new();
    for bounce in [0.5, 0.9, 0.99] {
        let scene = BouncingBall {
            bounce,
            ..BouncingBall::default()
        };
        let fall = (2.0 * scene.height / scene.gravity).sqrt();
        let limit = fall * (1.0 + bounce) / (1.0 - bounce);
        let trajectory = run(&scene, BouncingBall::DROPPED, 1.1 * limit)?;
        let rest = event(&trajectory, "floor", "accumulates", 0)?;
        figures.push(Figure::new(
            format!("time of rest, e = {bounce}"),
            relative(rest.time, limit),
            1e-12,
        ));
        let (then, end) = (&rest.state_after, trajectory.final_state());
        figures.push(Figure::new(
            format!("creep at rest, e = {bounce}, m/s"),
            distance(end.q[0], then.q[0]) / (0.1 * limit),
            1e-14,
        ));
    }
    Ok(figures)
}

/// Place, speed and slip at `until`, bounce by bounce.
fn bounce_by_bounce(ball: &ThrownBall, until: f64) -> (f64, f64, f64) {
    let ThrownBall {
        gravity,
        bounce,
        mu,
        ..
    } = *ball;
    let mut arrival = (2.0 * gravity * ball.height).sqrt();
    let (mut x, mut v, mut slip) = (0.0, ball.speed, ball.speed);
    let mut flight = arrival / gravity;
    // Σ eᵏ to rounding.
    for _ in 0..60 {
        x += v * flight;
        let most = 3.5 * mu * (1.0 + bounce) * arrival;
        let taken = slip.min(most);
        slip -= taken;
        v -= taken / 3.5;
        arrival *= bounce;
        flight = 2.0 * arrival / gravity;
    }
    let landed = (2.0 * ball.height / gravity).sqrt() * (1.0 + bounce) / (1.0 - bounce);
    let slide = slip / (3.5 * mu * gravity);
    x += v * slide - 0.5 * mu * gravity * slide * slide;
    v -= mu * gravity * slide;
    (x + v * (until - landed - slide), v, 0.0)
}

/// Balls that stop sliding in a bounce, and after the last.
pub(super) fn throws() -> [(&'static str, ThrownBall); 2] {
    let throw = |speed| ThrownBall {
        speed,
        ..ThrownBall::default()
    };
    [
        ("grips in a bounce", throw(4.0)),
        ("slides on after the last", throw(6.0)),
    ]
}

pub fn thrown_ball(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let mut figures = Vec::new();
    for (what, scene) in throws() {
        let trajectory = run(&scene, ThrownBall::THROWN, 3.0)?;
        let (x, v, _) = bounce_by_bounce(&scene, 3.0);
        let end = trajectory.final_state();
        figures.push(Figure::new(
            format!("{what}: 5/7 of the speed"),
            relative(end.v[0], 5.0 / 7.0 * scene.speed),
            1e-11,
        ));
        figures.push(Figure::new(
            format!("{what}: speed bounce by bounce"),
            relative(end.v[0], v),
            1e-11,
        ));
        figures.push(Figure::new(
            format!("{what}: place"),
            relative(end.q[0], x),
            1e-11,
        ));
        figures.push(Figure::new(
            format!("{what}: ledger"),
            closure(&trajectory)?,
            1e-11,
        ));
    }
    Ok(figures)
}

pub fn cradle(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = Cradle::default();
    let trajectory = run(&scene, Cradle::STRUCK, 1.0)?;
    story(&trajectory, &["pair[0] impact"])?;
    let expected = [-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    let speeds = trajectory.final_state().v.iter().zip(expected);
    let worst = speeds.map(|(v, e)| relative(*v, e)).fold(0.0, f64::max);
    Ok(vec![
        Figure::new("together: −1/3, 2/3, 2/3", worst, 1e-14),
        Figure::new("together: ledger", closure(&trajectory)?, 1e-14),
    ])
}

pub fn five_ball_cradle(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = FiveBallCradle::default();
    let starts = [
        ("one", FiveBallCradle::ONE),
        ("two", FiveBallCradle::TWO),
        ("three", FiveBallCradle::THREE),
    ];
    let mut figures = Vec::new();
    for (released, (name, start)) in starts.into_iter().enumerate() {
        let trajectory = run(&scene, start, 1.0)?;
        let speeds = trajectory.final_state().v.iter().enumerate();
        let leaves = |k: usize| if k + released >= 4 { scene.speed } else { 0.0 };
        let worst = speeds
            .map(|(k, v)| distance(*v, leaves(k)))
            .fold(0.0, f64::max);
        figures.push(Figure::new(
            format!("{name} in, {name} out, m/s"),
            worst,
            1e-14,
        ));
    }
    Ok(figures)
}

/// From upright at rate ω about a corner and back: (greatest tilt, time).
fn swing(rate: f64, alpha: f64, p2: f64) -> (f64, f64) {
    let lift = rate * rate / (4.0 * p2);
    let most = root(
        |m| (alpha - 0.5 * m).sin() * (0.5 * m).sin() - lift,
        0.0,
        alpha,
    );
    // θ = m (1 − u²): θ̇² = 4 p² sin(α − (θ + m)/2) sin((m − θ)/2), and u/√sin(m u²/2) is smooth.
    let slowness = |u: f64| {
        let (back, ahead) = (0.5 * most * u * u, alpha - most + 0.5 * most * u * u);
        let ratio = if back > 0.0 { back / back.sin() } else { 1.0 };
        2.0 * most * (2.0 * ratio / most).sqrt() / (4.0 * p2 * ahead.sin()).sqrt()
    };
    (most, 2.0 * integral(slowness, 0.0, 1.0))
}

/// Impacts of the block that are compared one by one.
const SWINGS: usize = 20;

pub fn rocking_block(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = RockingBlock::default();
    let RockingBlock {
        half_width: b,
        half_height: h,
        gravity,
        rate: first,
        ..
    } = scene;
    let alpha = (b / h).atan();
    let p2 = 0.75 * gravity / b.hypot(h);
    let share = 1.0 - 1.5 * alpha.sin().powi(2);
    let trajectory = run(&scene, RockingBlock::ROCKING, 10.0)?;
    let mut sampler = trajectory.sampler();
    let (mut rate, mut time) = (first, 0.0);
    let [mut tilts, mut times, mut rates] = [0.0_f64; 3];
    for k in 0..SWINGS {
        let (most, lasts) = swing(rate, alpha, p2);
        let top = sampler.at(time + 0.5 * lasts)?;
        tilts = tilts.max(relative(top.state.q[2].abs(), most));
        time += lasts;
        let hit = event(&trajectory, ["right", "left"][k % 2], "impact", k / 2)?;
        times = times.max(relative(hit.time, time));
        rate *= share;
        rates = rates.max(relative(hit.state_after.v[2].abs(), rate));
    }
    while rate > 1e-7 * first {
        time += swing(rate, alpha, p2).1;
        rate *= share;
    }
    // What is left is a geometric series.
    time += swing(rate, alpha, p2).1 / (1.0 - share);
    let rests = trajectory.events().iter();
    let rest = rests
        .filter(|e| matches!(e.kind, EventKind::Accumulates { .. }))
        .map(|e| e.time)
        .next();
    let rest = rest.ok_or_else(|| Surprise::Missing {
        event: "left or right accumulates".to_owned(),
    })?;
    let end = trajectory.final_state();
    let turns = end.v.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    Ok(vec![
        Figure::new("rates after twenty impacts", rates, 1e-11),
        Figure::new("times of twenty impacts", times, 1e-12),
        Figure::new("greatest tilts between", tilts, 1e-11),
        Figure::new("time at which it stands", relative(rest, time), 1e-12),
        Figure::new("tilt then, rad", end.q[2].abs(), 1e-12),
        Figure::new("motion then, m/s or rad/s", turns, 1e-14),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

pub fn string_pendulum(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = StringPendulum::default();
    let StringPendulum {
        length: l,
        gravity: g,
        speed,
        ..
    } = scene;
    let alpha = ((speed * speed / (g * l) - 2.0) / 3.0).asin();
    let (s, c) = alpha.sin_cos();
    let v = (g * l * s).sqrt();
    // From the bottom: β̇² = v₀²/l² − 2(g/l)(1 − cos β).
    let rate = |b: f64| (speed * speed / (l * l) - 4.0 * g / l * (0.5 * b).sin().powi(2)).sqrt();
    let slack = integral(|b| 1.0 / rate(b), 0.0, FRAC_PI_2 + alpha);
    let flight = 4.0 * v * c / g;
    let caught = [
        l * c - v * s * flight,
        l * s + v * c * flight - 0.5 * g * flight * flight,
    ];
    let arriving = [-v * s, v * c - g * flight];
    // What is left is the speed across the string.
    let across = (caught[0] * arriving[1] - caught[1] * arriving[0]) / l;
    let trajectory = run(&scene, StringPendulum::KICKED, slack + flight + 0.5)?;
    story(
        &trajectory,
        &["string lost", "string impact", "string closed"],
    )?;
    let lost = event(&trajectory, "string", "lost", 0)?;
    let hit = event(&trajectory, "string", "impact", 0)?;
    let after = &hit.state_after;
    Ok(vec![
        Figure::new(
            "height where it goes slack",
            relative(lost.state.q[1], l * s),
            1e-11,
        ),
        Figure::new("time of it", relative(lost.time, slack), 1e-11),
        Figure::new("flight", relative(hit.time - lost.time, flight), 1e-11),
        Figure::new(
            "place of the catch, m",
            distance(hit.state.q[0], caught[0]).max(distance(hit.state.q[1], caught[1])),
            1e-11,
        ),
        Figure::new(
            "speed after it",
            relative(
                (after.q[0] * after.v[1] - after.q[1] * after.v[0]) / l,
                across,
            ),
            1e-11,
        ),
        Figure::new("length, m", violation(&trajectory)?, 1e-12),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}
