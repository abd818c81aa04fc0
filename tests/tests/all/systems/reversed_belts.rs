//! Belts whose speed jumps: a friction is finite, so that what lies on them slips from there, the way the slip has jumped.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, times};

/// A block on a belt whose speed changes at once.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    define(belt = if(t <= change, first, second)),
    friction(rub: slip = der(x) - belt, normal = mass*gravity, static = held, kinetic = mu),
)]
struct Belt {
    mass: f64,
    gravity: f64,
    held: f64,
    mu: f64,
    change: f64,
    first: f64,
    second: f64,
}

/// The same on a table: a slip of two components.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass*gravity*z,
    define(belt = if(t <= change, first, second)),
    contact(table: z >= 0),
    friction(rub on table: slip = (der(x) - belt*cos(angle), der(y) - belt*sin(angle)), static = held, kinetic = mu),
)]
struct Table {
    mass: f64,
    gravity: f64,
    held: f64,
    mu: f64,
    change: f64,
    first: f64,
    second: f64,
    angle: f64,
}

/// Place and speed of a block a time after it was put on a belt.
fn carried([place, speed]: [f64; 2], belt: f64, braking: f64, time: f64) -> [f64; 2] {
    let slips = ((belt - speed).abs() / braking).min(time);
    let change = braking * slips * (belt - speed).signum();
    let place = place + (speed + change / 2.0) * slips;
    [place + (speed + change) * (time - slips), speed + change]
}

#[test]
fn a_block_follows_its_belt_by_friction_when_that_is_reversed() {
    let mut random = Random::new(11);
    for case in 0..16 {
        let mu = random.between(0.05, 0.4);
        let scene = Belt {
            mass: random.between(0.2, 5.0),
            gravity: 9.81,
            held: mu * random.between(1.0, 1.5),
            mu,
            change: random.between(0.1, 1.5),
            first: random.between(-2.0, 2.0),
            second: random.between(-2.0, 2.0),
        };
        let angle = random.between(-3.0, 3.0);
        let braking = mu * scene.gravity;
        let until = 2.0;
        let changes = carried([0.0; 2], scene.first, braking, scene.change);
        let [place, speed] = carried(changes, scene.second, braking, until - scene.change);
        let table = Table {
            mass: scene.mass,
            gravity: scene.gravity,
            held: scene.held,
            mu,
            change: scene.change,
            first: scene.first,
            second: scene.second,
            angle,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let line = run_by(&scene, (method, tolerance), state(&[0.0], &[0.0]), until);
            agree(&what, line.final_state().q[0], place, 50.0 * tolerance);
            agree(&what, line.final_state().v[0], speed, 50.0 * tolerance);
            certified(&what, &line);
            let plane = run_by(
                &table,
                (method, tolerance),
                state(&[0.0; 3], &[0.0; 3]),
                until,
            );
            let [x, y, _] = plane.final_state().q[..] else {
                panic!("three coordinates")
            };
            agree(&what, x, place * angle.cos(), 50.0 * tolerance);
            agree(&what, y, place * angle.sin(), 50.0 * tolerance);
            certified(&what, &plane);
        }
    }
}

/// A block on two belts that meet and run against one another.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass*gravity*y,
    contact(floor: y >= 0),
    friction(rub on floor: slip = der(x) - if(x <= seam, belt, -belt), static = mu),
)]
struct Seam {
    mass: f64,
    gravity: f64,
    seam: f64,
    belt: f64,
    mu: f64,
}

/// The first belt has taken it along when it comes to the seam. The second brakes it and sends it back at the same speed, and so does the first, for ever.
#[test]
fn a_block_swings_between_two_belts() {
    for (seam, belt, mu) in [(1.0, 1.0, 0.3), (0.4, 0.7, 0.2), (2.0, 1.6, 0.5)] {
        let scene = Seam {
            mass: 2.0,
            gravity: 9.81,
            seam,
            belt,
            mu,
        };
        let braking = mu * scene.gravity;
        let arrives = (seam - belt * belt / (2.0 * braking)) / belt + belt / braking;
        let half = 2.0 * belt / braking;
        let until = arrives + 5.3 * half;
        // Three tenths of the way on the second belt, after five swings.
        let time = 0.3 * half;
        let place = seam - belt * time + braking / 2.0 * time * time;
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 2], &[0.0; 2]),
                until,
            );
            agree(&what, run.final_state().q[0], place, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// Luggage at the end stop of a belt that is switched off, with and without a second component of the slip.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z, line, height),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2 + der(line)^2 + der(height)^2)/2,
    potential = gravity*(z + height),
    define(belt = if(t <= off, speed, 0)),
    contact(floor: z >= 0),
    contact(end: x <= 0),
    friction(rub on floor: slip = (der(x) - belt, der(y)), static = mu),
    contact(ground: height >= 0),
    contact(stop: line <= 0),
    friction(grip on ground: slip = der(line) - belt, static = mu),
)]
struct Luggage {
    gravity: f64,
    off: f64,
    speed: f64,
    mu: f64,
}

/// It rests on the belt from there on, and nothing presses it against the stop.
#[test]
fn luggage_rests_when_its_belt_is_switched_off() {
    for (off, speed, mu) in [(1.0, 1.0, 0.3), (0.6, 0.2, 0.5), (1.7, 2.5, 0.1)] {
        let scene = Luggage {
            gravity: 9.81,
            off,
            speed,
            mu,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let rest = state(&[0.0; 5], &[0.0; 5]);
            let run = run_by(&scene, (method, tolerance), rest, 3.0);
            let mut sampler = run.sampler();
            let pushed = sampler.at(0.5 * off).expect("before");
            let left = sampler.at(0.5 * (off + 3.0)).expect("after");
            for contact in [Luggage::END, Luggage::STOP] {
                agree(&what, pushed.force(contact), mu * 9.81, 1e-9);
                agree(&what, left.force(contact), 0.0, 1e-9);
            }
            agree(&what, left.force(Luggage::GRIP), 0.0, 1e-9);
            let sticks = times(&run, "rub", "sticks");
            agree(&what, sticks[0], off, 10.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A brake whose limit changes while it holds, at times exactly to what it has to hold.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2)/2,
    force(pull: x = strength),
    force(drag: y = strength),
    friction(brake: slip = der(x), limit = if(t <= change, 2*strength, after)),
    friction(pads: slip = (der(y), der(z)), limit = if(t <= change, 2*strength, after)),
)]
struct Brake {
    strength: f64,
    change: f64,
    after: f64,
}

#[test]
fn a_brake_that_changes_while_it_holds() {
    // At its limit it holds on.
    for (strength, change, after) in [
        (1.0, 1.0, 0.0),
        (1.0, 1.0, 1.0),
        (0.7, 0.9, 0.3),
        (1.3, 0.4, 1.3),
        (0.0, 1.0, 0.0),
    ] {
        let scene = Brake {
            strength,
            change,
            after,
        };
        let gone = (strength - after) / 2.0 * (2.0 - change) * (2.0 - change);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let rest = state(&[0.0; 3], &[0.0; 3]);
            let run = run_by(&scene, (method, tolerance), rest, 2.0);
            for (q, expected) in run.final_state().q.iter().zip([gone, gone, 0.0]) {
                agree(&what, *q, expected, 50.0 * tolerance);
            }
            certified(&what, &run);
        }
    }
}
