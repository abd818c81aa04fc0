//! More supports than balance can tell apart: forces that are not determined, and what happens all the same.

use super::kit::{closure, event, relative, run, violation};
use crate::reference::root;
use crate::scenes::hard::{BeamOnSupports, RodOnSupports, Sled, Table};
use lagrange_program::stability::{Extent, Figure, Surprise};

/// 1 unless `flags` are those expected.
fn wrongly_flagged(flags: &[bool], expected: &[bool]) -> f64 {
    f64::from(u8::from(flags != expected))
}

/// The largest error of `forces` relative to `scale`.
fn worst(forces: &[f64], expected: &[f64], scale: f64) -> f64 {
    let errors = forces.iter().zip(expected).map(|(f, e)| (f - e).abs());
    errors.fold(0.0, f64::max) / scale
}

pub fn rod_on_supports(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = RodOnSupports::default();
    let RodOnSupports {
        mass,
        gravity,
        back,
        front,
        rate,
        mu_static,
        mu_kinetic,
        ..
    } = scene;
    let weight = mass * gravity;
    let starts = mu_static * weight / rate;
    let place = |t: f64| {
        let wait = t - starts;
        rate / (6.0 * mass) * wait * wait * (t + 2.0 * starts)
            - 0.5 * mu_kinetic * gravity * wait * wait
    };
    let tips = root(|t| place(t) - front, starts, starts + 10.0);
    let trajectory = run(&scene, RodOnSupports::RESTING, 10.0)?;
    let slips = event(&trajectory, "left_grip", "slips", 0)?;
    let other = event(&trajectory, "right_grip", "slips", 0)?;
    let lost = event(&trajectory, "left", "lost", 0)?;
    let normals = [
        weight * front / (back + front),
        weight * back / (back + front),
    ];
    let before = trajectory.sampler().at(0.5 * starts)?;
    Ok(vec![
        Figure::new(
            "both grips slip at F = μ m g",
            relative(slips.time, starts).max(relative(other.time, starts)),
            1e-12,
        ),
        Figure::new(
            "normal forces there",
            worst(&slips.forces, &normals, weight),
            1e-12,
        ),
        Figure::new(
            "friction before, halves",
            worst(&before.forces[2..], &[-0.25 * rate * starts; 2], weight),
            1e-12,
        ),
        Figure::new(
            "not flagged, or wrongly",
            wrongly_flagged(&before.undetermined, &[false, false, true, true]),
            0.0,
        ),
        Figure::new("time where it tips", relative(lost.time, tips), 1e-11),
        Figure::new("penetration, m", violation(&trajectory)?, 1e-12),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

pub fn beam_on_supports(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = BeamOnSupports::default();
    let BeamOnSupports {
        mass,
        gravity,
        span,
        weight,
        speed,
        ..
    } = scene;
    let total = mass * gravity + weight;
    let tips = span * total / weight / speed;
    let trajectory = run(&scene, BeamOnSupports::RESTING, 10.0)?;
    let lost = [0, 1].map(|k| event(&trajectory, ["support[0]", "support[1]"][k], "lost", 0));
    let [left, middle] = lost;
    let late = relative(left?.time, tips).max(relative(middle?.time, tips));
    let mut sampler = trajectory.sampler();
    let mut shares: f64 = 0.0;
    let mut flags: f64 = 0.0;
    for part in [0.1, 0.4, 0.6, 0.7, 0.9, 0.999] {
        let now = sampler.at(part * tips)?;
        let moment = weight * speed * part * tips;
        let tilt = moment / (2.0 * span);
        let expected = if tilt <= total / 3.0 {
            [total / 3.0 - tilt, total / 3.0, total / 3.0 + tilt]
        } else {
            [0.0, total - moment / span, moment / span]
        };
        shares = shares.max(worst(&now.forces, &expected, total));
        flags = flags.max(wrongly_flagged(&now.undetermined, &[true; 3]));
    }
    Ok(vec![
        Figure::new("tips where the load is too far out", late, 1e-12),
        Figure::new("shares of least norm, none negative", shares, 1e-12),
        Figure::new("not flagged", flags, 0.0),
        Figure::new("penetration, m", violation(&trajectory)?, 1e-12),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

pub fn sled(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let scene = Sled::default();
    let Sled {
        mass,
        gravity,
        span,
        height,
        mu,
        speed,
        ..
    } = scene;
    let weight = mass * gravity;
    let rests = speed / (mu * gravity);
    let trajectory = run(&scene, Sled::SLIDING, 2.0 * rests)?;
    let mut late: f64 = 0.0;
    for grip in ["grip[0]", "grip[1]", "grip[2]"] {
        late = late.max(relative(event(&trajectory, grip, "sticks", 0)?.time, rests));
    }
    let mut sampler = trajectory.sampler();
    let sliding = sampler.at(0.5 * rests)?;
    let resting = sampler.at(1.5 * rests)?;
    let tilt = mu * height / span;
    let (rear, front) = (weight * (1.0 - tilt), weight * tilt);
    let sliding_forces = [0.0, rear, front, 0.0, -mu * rear, -mu * front];
    let third = weight / 3.0;
    let resting_forces = [third, third, third, 0.0, 0.0, 0.0];
    let end = trajectory.final_state();
    Ok(vec![
        Figure::new("time until it rests", late, 1e-12),
        Figure::new(
            "way until it rests",
            relative(end.q[0], 0.5 * speed * rests),
            1e-12,
        ),
        Figure::new(
            "shares while it slides",
            worst(&sliding.forces, &sliding_forces, weight),
            1e-12,
        ),
        Figure::new(
            "shares at rest",
            worst(&resting.forces, &resting_forces, weight),
            1e-12,
        ),
        Figure::new(
            "not flagged",
            wrongly_flagged(&sliding.undetermined, &[true; 6])
                .max(wrongly_flagged(&resting.undetermined, &[true; 6])),
            0.0,
        ),
        Figure::new("creep, m/s", end.v[0].abs(), 1e-14),
        Figure::new("penetration, m", violation(&trajectory)?, 1e-12),
        Figure::new("ledger", closure(&trajectory)?, 1e-11),
    ])
}

pub fn table(_: Extent) -> Result<Vec<Figure>, Surprise> {
    let (mut late, mut off, mut turned, mut sum): (f64, f64, f64, f64) = (0.0, 0.0, 0.0, 0.0);
    let mut unflagged: f64 = 0.0;
    let mut books: f64 = 0.0;
    for direction in [0.0, 0.6, 2.0, 4.0] {
        let scene = Table {
            direction,
            ..Table::default()
        };
        let Table {
            mass,
            gravity,
            mu_static,
            mu_kinetic,
            rate,
            ..
        } = scene;
        let weight = mass * gravity;
        let slips = mu_static * weight / rate;
        let until = 1.5 * slips;
        let trajectory = run(&scene, Table::STANDING, until)?;
        for k in ["fore_left", "fore_right", "rear_left", "rear_right"] {
            let found = event(&trajectory, &format!("grip_{k}"), "slips", 0)?;
            late = late.max(relative(found.time, slips));
        }
        let wait = until - slips;
        let speed = (0.5 * rate * (until + slips) - mu_kinetic * weight) * wait / mass;
        let end = trajectory.final_state();
        let (sin, cos) = direction.sin_cos();
        off = off.max((end.v[0] - speed * cos).hypot(end.v[1] - speed * sin) / speed);
        turned = turned.max(end.q[2].abs());
        let now = trajectory.sampler().at(0.5 * slips)?;
        let normal: f64 = now.forces[..4].iter().sum();
        sum = sum.max(relative(normal, weight));
        unflagged = unflagged.max(wrongly_flagged(&now.undetermined, &[true; 12]));
        books = books.max(closure(&trajectory)?);
    }
    Ok(vec![
        Figure::new("all legs slip at F = μ m g", late, 1e-12),
        Figure::new("velocity", off, 1e-11),
        Figure::new("the table turns, rad", turned, 1e-12),
        Figure::new("the legs carry", sum, 1e-13),
        Figure::new("not flagged", unflagged, 0.0),
        Figure::new("ledger", books, 1e-11),
    ])
}
