//! Contacts that open, frictions that stick and slip.

use super::kit::{TOLERANCE, closure, distance, event, relative, run, story, violation};
use crate::reference::integral;
use crate::scenes::hard::{BackspinBall, BeltOscillator, CoulombOscillator, Ladder, PainleveRod};
use core::f64::consts::PI;
use lagrange_core::prelude::*;
use lagrange_program::stability::{Extent, Figure, Surprise};

pub fn ladder(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = Ladder::default();
    let Ladder {
        length: l,
        gravity: g,
        start_angle,
        ..
    } = scene;
    let top = start_angle.sin();
    let leaves = (2.0 / 3.0 * top).asin();
    // θ = θ₀ − u: sin θ₀ − sin θ = 2 cos(θ₀ − ½u) sin ½u.
    let slow =
        |u: f64| 1.0 / (6.0 * g / l * (start_angle - 0.5 * u).cos() * (0.5 * u).sin()).sqrt();
    let time = integral(slow, 0.0, start_angle - leaves);
    let speed = top / 3.0 * (g * l * top).sqrt();
    // On the floor alone: (cos²θ/4 + 1/12) l² θ̇²/2 + g l/2 sin θ is conserved.
    let weight = |th: f64| (0.25 * th.cos().powi(2) + 1.0 / 12.0) * l * l;
    let energy = 0.5 * weight(leaves) * g * top / l + 0.5 * g * l * leaves.sin();
    let rate = |th: f64| (2.0 * (energy - 0.5 * g * l * th.sin()) / weight(th)).sqrt();
    let fall = integral(|th| 1.0 / rate(th), 0.0, leaves);
    let trajectory = run(&scene, Ladder::LEANING, 10.0)?;
    story(&trajectory, &["wall lost", "flat stop"])?;
    let lost = event(&trajectory, "wall", "lost", 0)?;
    let flat = event(&trajectory, "flat", "stop", 0)?;
    Ok(vec![
        Figure::new(
            "sin θ where it leaves",
            relative(lost.state.q[2].sin(), leaves.sin()),
            1e-10,
        ),
        Figure::new("time of it", relative(lost.time, time), 1e-10),
        Figure::new(
            "speed along the floor",
            relative(flat.state.v[0], speed),
            1e-10,
        ),
        Figure::new("time of the fall", relative(flat.time, time + fall), 1e-10),
        Figure::new(
            "rate of the fall",
            relative(-flat.state.v[2], rate(0.0)),
            1e-10,
        ),
        Figure::new("penetration, m", violation(&trajectory)?, 1e-12),
    ])
}

pub fn backspin_ball(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = BackspinBall::default();
    let BackspinBall {
        radius,
        gravity,
        mu,
        speed,
        spin,
        ..
    } = scene;
    let slip = speed + radius * spin;
    let (time, rolls) = (2.0 * slip / (7.0 * mu * gravity), speed - 2.0 / 7.0 * slip);
    let until = time + 2.0;
    let trajectory = run(&scene, BackspinBall::STRUCK, until)?;
    story(&trajectory, &["grip sticks"])?;
    let sticks = event(&trajectory, "grip", "sticks", 0)?;
    let end = trajectory.final_state();
    let place = 0.5 * (speed + rolls) * time + rolls * (until - time);
    Ok(vec![
        Figure::new("time until it rolls", relative(sticks.time, time), 1e-12),
        Figure::new("speed back", relative(end.v[0], rolls), 1e-12),
        Figure::new("place", relative(end.q[0], place), 1e-12),
        Figure::new(
            "slip while it rolls, m/s",
            (end.v[0] - radius * end.v[2]).abs(),
            1e-14,
        ),
        Figure::new("ledger", closure(&trajectory)?, 1e-12),
    ])
}

pub fn belt_oscillator(_: Extent) -> Result<Vec<Figure>, Surprise> {
    const CYCLES: usize = 200;
    let scene = BeltOscillator::default();
    let BeltOscillator {
        mass,
        gravity,
        stiffness,
        speed,
        mu_static,
        mu_kinetic,
    } = scene;
    let (high, middle) = (
        mu_static * mass * gravity / stiffness,
        mu_kinetic * mass * gravity / stiffness,
    );
    let omega = (stiffness / mass).sqrt();
    let slide = 2.0 * (PI - (omega * (high - middle) / speed).atan()) / omega;
    let period = slide + 2.0 * (high - middle) / speed;
    let last = high / speed + CYCLES as f64 * period;
    let trajectory = run(&scene, BeltOscillator::RIDING, last + 0.1)?;
    let first = event(&trajectory, "grip", "slips", 0)?;
    let slips = event(&trajectory, "grip", "slips", CYCLES)?;
    let sticks = event(&trajectory, "grip", "sticks", CYCLES - 1)?;
    Ok(vec![
        Figure::new("first slip", relative(first.time, high / speed), 1e-12),
        Figure::new(
            format!("period over {CYCLES} cycles"),
            relative(slips.time - first.time, CYCLES as f64 * period),
            1e-12,
        ),
        Figure::new(
            "where it is caught",
            relative(sticks.state.q[0], 2.0 * middle - high),
            1e-11,
        ),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

pub fn coulomb_oscillator(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = CoulombOscillator::default();
    let CoulombOscillator {
        mass,
        gravity,
        stiffness,
        mu_static,
        mu_kinetic,
        amplitude,
    } = scene;
    let (lost, band) = (
        2.0 * mu_kinetic * mass * gravity / stiffness,
        mu_static * mass * gravity / stiffness,
    );
    let mut swings = 0;
    while amplitude - lost * f64::from(swings) > band {
        swings += 1;
    }
    let place = (amplitude - lost * f64::from(swings)) * if swings % 2 == 0 { 1.0 } else { -1.0 };
    let time = f64::from(swings) * PI / (stiffness / mass).sqrt();
    let trajectory = run(&scene, CoulombOscillator::STRETCHED, time + 100.0)?;
    let mut expected = vec!["grip reverses"; swings as usize];
    expected[0] = "grip slips";
    expected.push("grip sticks");
    story(&trajectory, &expected)?;
    let stops = event(&trajectory, "grip", "sticks", 0)?;
    let end = trajectory.final_state();
    Ok(vec![
        Figure::new(
            format!("time of {swings} half swings"),
            relative(stops.time, time),
            1e-11,
        ),
        Figure::new("where it stops", relative(end.q[0], place), 1e-11),
        Figure::new(
            "creep, m/s",
            distance(end.q[0], stops.state_after.q[0]) / 100.0,
            1e-14,
        ),
    ])
}

pub fn painleve_rod(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let slides = PainleveRod::default();
    let (s, c) = slides.start_angle.sin_cos();
    // Two answers above θ̇² = g/(l sin θ), none below.
    let flies = PainleveRod {
        mu: 2.0,
        rate: 6.0,
        ..slides.clone()
    };
    let neither = PainleveRod {
        mu: 2.0,
        ..slides.clone()
    };
    let pushes = |rod: &PainleveRod| (1.0 + 3.0 * c * (c - rod.mu * s)) / rod.mass;
    let normal = slides.gravity / pushes(&slides);
    let trajectory = run(&slides, PainleveRod::SLIDING, 1.0)?;
    let found = trajectory.sampler().at(0.0)?.forces[trajectory.description().contacts[0].row];
    let two = run(&flies, PainleveRod::SLIDING, 0.01)?;
    let flagged = two.events().iter().any(|e| e.ambiguous);
    let refused = Simulation::new(&neither)
        .tolerance(TOLERANCE)
        .run(neither.at(PainleveRod::SLIDING), 0.0..0.01);
    match refused.map(|_| ()).map_err(|failure| failure.error) {
        Err(Error::NoMode { .. }) => {}
        other => {
            return Err(Surprise::NotRefused {
                expected: "no mode continues the motion at `tip`",
                found: other.err(),
            });
        }
    }
    Ok(vec![
        Figure::new("one answer: normal force", relative(found, normal), 1e-13),
        Figure::new("one answer: ledger", closure(&trajectory)?, 1e-11),
        Figure::new(
            "two answers: not flagged",
            f64::from(u8::from(!flagged)),
            0.0,
        ),
        Figure::new("no answer: not refused", 0.0, 0.0),
    ])
}
