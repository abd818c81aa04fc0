//! The onset of slip in space: its direction is that of the motion which it lets begin.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, event, methods_at, root, run, run_by};

/// A sledge whose inertia differs along and across, pushed ever harder.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = light/2 * der(x)^2 + heavy/2 * der(y)^2,
    force(shove: x = 3 * t),
    force(push: y = 4 * t),
    friction(grip: slip = (der(x), der(y)), limit = (holds, drags)),
)]
struct Sledge {
    light: f64,
    heavy: f64,
    holds: f64,
    drags: f64,
}

/// At t = Fs/5 the push is F = Fs (3, 4)/5. With a = α u it holds that (mᵢ α + Fk) uᵢ = Fᵢ, and |u| = 1 gives α.
#[test]
fn slip_begins_along_its_own_acceleration() {
    let scene = Sledge {
        light: 0.5,
        heavy: 4.0,
        holds: 2.0,
        drags: 1.2,
    };
    let begin = scene.holds / 5.0;
    let masses = [scene.light, scene.heavy];
    let push = [3.0 * begin, 4.0 * begin];
    let direction = |alpha: f64| [0, 1].map(|i| push[i] / (masses[i] * alpha + scene.drags));
    let excess = |alpha: f64| direction(alpha).iter().map(|u| u * u).sum::<f64>() - 1.0;
    let alpha = root(excess, 0.0, 10.0);
    let u = direction(alpha);
    let motion = run(&scene, state(&[0.0; 2], &[0.0; 2]), 0.5);
    let onset = event(&motion, "grip", "slips");
    agree("time", onset.time, begin, 1e-13);
    let row = motion.description().frictions[0].row;
    for i in 0..2 {
        agree("held", onset.forces[row + i], -push[i], 1e-12);
        agree(
            "drag",
            onset.forces_after[row + i],
            -scene.drags * u[i],
            1e-10,
        );
        // The straight beginning, up to what the push grows by.
        let after = 1e-5;
        let now = motion.sampler().at(begin + after).expect("within");
        agree("speed", now.state.v[i] / after, alpha * u[i], 1e-4);
    }
}

/// A mass goes with a table that turns faster and faster.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    friction(rub: slip = (der(x) + spin*t*y, der(y) - spin*t*x), normal = 9.81, static = mu, kinetic = mu/2),
    observe(along_x = rub[0], along_y = rub[1]),
    start(rests: x = radius),
)]
struct Turning {
    spin: f64,
    radius: f64,
    mu: f64,
}

/// As its slip begins friction falls to half, in the same direction: not in that of what rounding has left of the slip.
#[test]
fn what_is_read_as_a_slip_begins_has_its_direction() {
    for (spin, radius, mu) in [(0.5, 0.1, 0.3), (0.3, 0.2, 0.4), (0.8, 0.15, 0.5)] {
        let scene = Turning { spin, radius, mu };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&scene, (method, tolerance), scene.at(Turning::RESTS), 30.0);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let slips = event(&motion, "rub", "slips");
            let mut sampler = motion.sampler();
            let [before, after] = [
                sampler.before(slips).expect("recorded"),
                sampler.after(slips).expect("recorded"),
            ];
            for output in [Turning::ALONG_X, Turning::ALONG_Y] {
                let expected = before.observe(output) / 2.0;
                agree(&what, after.observe(output), expected, 10.0 * tolerance);
            }
        }
    }
}

/// A pad that is pressed and pulled by loads that grow from zero, with inertia that differs along and across.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(load = linear*t + square*t^2 + cube*t^3),
    kinetic = light/2 * der(x)^2 + heavy/2 * der(y)^2,
    force(shove: x = pull_x * load),
    force(push: y = pull_y * load),
    friction(pad: slip = (der(x), der(y)), normal = load, static = rough),
)]
struct Pressed {
    light: f64,
    heavy: f64,
    linear: f64,
    square: f64,
    cube: f64,
    pull_x: f64,
    pull_y: f64,
    rough: f64,
}

/// With loads N(t) the velocities are w ∫N, where (mᵢ α + μ) uᵢ = Fᵢ/N and w = α u, and |u| = 1 gives α: no force acts when the slip begins.
#[test]
fn slip_begins_under_loads_that_grow_from_zero() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let mut random = Random::new(31);
        for k in 0..12 {
            let size = random.between(1.0, 20.0);
            let grows = |order: usize| if k % 3 == order { size } else { 0.0 };
            let (pull, angle) = (random.between(0.2, 0.6), random.between(0.0, 6.0));
            let scene = Pressed {
                light: random.between(0.5, 1.0),
                heavy: random.between(1.0, 4.0),
                linear: grows(0),
                square: grows(1),
                cube: grows(2),
                pull_x: pull * angle.cos(),
                pull_y: pull * angle.sin(),
                rough: pull * random.between(0.05, 0.9),
            };
            let masses = [scene.light, scene.heavy];
            let pulls = [scene.pull_x, scene.pull_y];
            let direction =
                |alpha: f64| [0, 1].map(|i| pulls[i] / (masses[i] * alpha + scene.rough));
            let excess = |alpha: f64| direction(alpha).iter().map(|u| u * u).sum::<f64>() - 1.0;
            let alpha = root(excess, 0.0, 10.0);
            let (end, power) = (0.8_f64, 2.0 + (k % 3) as f64);
            let pressed = size * end.powf(power) / power;
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 2], &[0.0; 2]),
                end,
            );
            for (v, u) in run.final_state().v.iter().zip(direction(alpha)) {
                let asked = format!("{method} {tolerance:e}, {k}");
                agree(asked, *v, alpha * u * pressed, 1e2 * tolerance * size);
            }
        }
    }
}
