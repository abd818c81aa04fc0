//! Motions that end, or turn, exactly at the edge of a surface, as round numbers have it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, times, words,
};

const G: f64 = 9.81;

/// A block that slides along a table and is pushed back by a wind.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(table: y >= 0, where x <= length),
    friction(grip on table: slip = der(x), static = mu),
    force(wind: -push along der(x)),
)]
struct Block {
    length: f64,
    gravity: f64,
    mu: f64,
    push: f64,
}

fn tenths(random: &mut Random, low: usize, many: usize) -> f64 {
    (low + random.below(many)) as f64 / 10.0
}

/// Rounding says whether it is on the table still: it stays where it has stopped, or falls from there.
#[test]
fn a_block_that_stops_at_the_edge_stays_or_falls() {
    let mut random = Random::new(7);
    for case in 0..25 {
        let (speed, mu) = (tenths(&mut random, 3, 28), tenths(&mut random, 1, 7));
        let gravity = [9.81, 10.0][case % 2];
        let scene = Block {
            length: speed * speed / (2.0 * mu * gravity),
            gravity,
            mu,
            push: 0.0,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 2], &[speed, 0.0]),
                4.0,
            );
            let end = run.final_state();
            let stays = end.q[1].abs() <= tolerance;
            assert!(stays || end.q[1] < -1.0, "{what}: {end:?}");
            // An error of the place is the square of one of the speed with which it flies on.
            let known = match stays {
                true => 20.0 * tolerance,
                false => 20.0 * tolerance.sqrt(),
            };
            agree(&what, end.q[0], scene.length, known);
            certified(&what, &run);
        }
    }
}

/// It goes back as it came, or is lost there and falls.
#[test]
fn a_block_that_turns_at_the_edge_goes_back_or_falls() {
    let mut random = Random::new(8);
    for case in 0..25 {
        let (speed, push) = (tenths(&mut random, 3, 28), tenths(&mut random, 10, 80));
        let scene = Block {
            length: speed * speed / (2.0 * push),
            gravity: 9.81,
            mu: 0.0,
            push,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let until = 2.0 * speed / push;
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 2], &[speed, 0.0]),
                until,
            );
            let end = run.final_state();
            agree(&what, end.q[0], 0.0, 100.0 * tolerance);
            assert!(
                end.q[1].abs() <= tolerance || end.q[1] < -0.01,
                "{what}: {end:?}"
            );
            certified(&what, &run);
        }
    }
}

/// A box that slides over the end of a table and tips: its lower corners touch the table, and the edge of the table its lower face.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    define(
        rear_x = x - wide*cos(turn) + tall*sin(turn),
        rear_y = y - wide*sin(turn) - tall*cos(turn),
        front_x = x + wide*cos(turn) + tall*sin(turn),
        front_y = y + wide*sin(turn) - tall*cos(turn),
        beneath = (1 + drift*t - x)*cos(turn) - y*sin(turn),
        below = (1 + drift*t - x)*sin(turn) + y*cos(turn),
    ),
    kinetic = (der(x)^2 + der(y)^2)/2 + inertia/2*der(turn)^2,
    potential = 10*y,
    contact(rear: rear_y >= 0, where rear_x <= 1 + drift*t),
    contact(front: front_y >= 0, where front_x <= 1 + drift*t),
    contact(edge: below >= tall, where wide^2 >= beneath^2),
    start(slides: x = from, y = tall, der(x) = speed + drift),
)]
struct OverTheEnd {
    wide: f64,
    tall: f64,
    inertia: f64,
    from: f64,
    speed: f64,
    drift: f64,
}

/// Its rear corner passes the edge just as the edge leaves its face: nothing is hit there.
#[test]
fn the_last_corner_of_a_box_passes_the_end_of_a_table() {
    for (wide, tall, inertia, from, speed, drift) in [
        (0.3, 0.05, 0.05, 0.6, 1.0, 0.0),
        (0.1, 0.2, 0.05, 0.8, 0.39, -2.0),
        (0.3, 0.2, 0.02, 0.9, 0.7, 1.0),
        (0.5, 0.4, 0.05, 0.8, 0.3, 0.0),
    ] {
        let body = OverTheEnd {
            wide,
            tall,
            inertia,
            from,
            speed,
            drift,
        };
        // It tips from where its centre passes the edge, and has left it when its angle is about 1.
        let end = (1.0 - from) / speed + 0.75 * wide / speed.max(0.5) + 0.1;
        let runs: Vec<_> = methods_at(METHODS, TOLERANCES)
            .map(|(method, tolerance)| {
                let what = format!("{body:?} by {method} at {tolerance:e}");
                let run = run_by(&body, (method, tolerance), body.at(OverTheEnd::SLIDES), end);
                for corner in ["rear", "front"] {
                    assert!(
                        times(&run, corner, "impact").is_empty(),
                        "{what}: {:?}",
                        words(&run)
                    );
                }
                certified(&what, &run);
                (what, tolerance, run.final_state().clone())
            })
            .collect();
        let (_, coarse, first) = &runs[0];
        for (what, tolerance, last) in &runs {
            for j in 0..3 {
                agree(what, last.q[j], first.q[j], 1e4 * tolerance.max(*coarse));
            }
        }
    }
}

/// A block at rest at the edge of a table, under a load that grows from zero.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass*gravity*y,
    contact(table: y >= 0, where x <= length),
    friction(grip on table: slip = der(x), static = mu),
    force(load: x = grows*t),
    start(rest: x = length),
)]
struct Loaded {
    mass: f64,
    gravity: f64,
    length: f64,
    mu: f64,
    grows: f64,
}

/// It begins to slide at μ m g/F′, and where it is pulled outward it is over the edge at that instant: a root of its region, which begins with t³, would be off
/// by the cube root of rounding. Pulled inward it slides on the table.
#[test]
fn a_growing_load_pulls_what_rests_at_an_edge_over_it() {
    for (mass, length, mu, grows) in [
        (1.3, 0.7, 0.0, 1.7),
        (1.3, 0.7, 0.25, 2.9),
        (0.4, 3.1, 0.1, 0.9),
        (2.0, 1.0, 0.0, -1.1),
        (0.8, 0.3, 0.2, -2.3),
    ] {
        let scene = Loaded {
            mass,
            gravity: G,
            length,
            mu,
            grows,
        };
        let begins = mu * mass * G / f64::abs(grows);
        let (until, falls) = (begins + 1.5, grows > 0.0);
        // Friction holds back what is on the table with the load at which it began to slide.
        let held = if falls { 0.0 } else { begins };
        let speed = |t: f64| grows * (t * t - begins * begins) / (2.0 * mass);
        let gone = |t: f64| {
            let grown = (t.powi(3) - begins.powi(3)) / 6.0 - begins * begins * (t - begins) / 2.0;
            let braked = held * (t - begins).powi(2) / 2.0;
            grows / mass * (grown - braked)
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), scene.at(Loaded::REST), until);
            let State { q, v, .. } = run.final_state();
            let bound = (100.0 * tolerance).max(1e-11);
            agree(&what, q[0], length + gone(until), bound);
            let falling = if falls { 1.5 } else { 0.0 };
            agree(&what, q[1], -G / 2.0 * falling * falling, bound);
            if falls {
                agree(&what, v[0], speed(until), bound);
            }
            certified(&what, &run);
        }
    }
}

/// A mass at rest at the lower end of a smooth ramp, with a force along the floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(ramp: y >= slope*(length - x), where x <= length),
    force(wind: x = push),
    start(rest: x = length),
)]
struct RampEnd {
    gravity: f64,
    slope: f64,
    length: f64,
    push: f64,
}

/// The ramp would push it out, so that it leaves it. Beyond nothing pushes it, and it falls beside the end; a wind that is strong enough drives it up.
#[test]
fn what_rests_at_the_end_of_a_ramp_falls_beside_it_or_is_driven_up() {
    for (slope, length, push) in [
        (0.7, 1.3, 0.0),
        (0.2, 0.9, 0.6),
        (1.1, 2.0, 0.3),
        (0.4, 1.0, -7.5),
    ] {
        let scene = RampEnd {
            gravity: G,
            slope,
            length,
            push,
        };
        // Along the ramp, per unit of x.
        let drive = push + slope * G;
        let [ax, ay] = match drive < 0.0 {
            true => {
                let a = drive / (1.0 + slope * slope);
                [a, -slope * a]
            }
            false => [push, -G],
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), scene.at(RampEnd::REST), 1.2);
            let State { q, .. } = run.final_state();
            let bound = (100.0 * tolerance).max(1e-11);
            agree(&what, q[0], length + ax * 0.72, bound);
            agree(&what, q[1], ay * 0.72, bound);
            certified(&what, &run);
        }
    }
}

/// A block that a brake brings to rest exactly at the edge, and that is pulled on later.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(table: y >= 0, where x <= length),
    friction(grip on table: slip = der(x), static = mu),
    force(load: x = grows*max(t - late, 0)),
)]
struct BrakedAndPulled {
    gravity: f64,
    length: f64,
    mu: f64,
    grows: f64,
    late: f64,
}

#[test]
fn a_load_pulls_on_what_a_brake_has_stopped_at_the_edge() {
    for (speed, mu, grows) in [(2.0, 0.2, 3.0), (1.0, 0.05, 1.5), (1.5, 0.1125, 2.0)] {
        let scene = BrakedAndPulled {
            gravity: 10.0,
            length: speed * speed / (20.0 * mu),
            mu,
            grows,
            late: 2.5,
        };
        let begins = scene.late + 10.0 * mu / grows;
        let (until, dt) = (begins + 1.0, 1.0);
        let gone = 10.0 * mu * dt * dt / 2.0 + grows * dt / 6.0;
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let start = state(&[0.0; 2], &[speed, 0.0]);
            let run = run_by(&scene, (method, tolerance), start, until);
            let State { q, .. } = run.final_state();
            let bound = (100.0 * tolerance).max(1e-10);
            agree(&what, q[0], scene.length + gone, bound);
            agree(&what, q[1], -5.0, bound);
            certified(&what, &run);
        }
    }
}

/// A puck that slides along the slanted border of a table, with a wind.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2)/2,
    potential = gravity*z,
    contact(table: z >= 0, where a*x + b*y <= 1),
    force(wind: x = push),
    start(slides: x = 1/a, der(x) = speed*b, der(y) = -speed*a),
)]
struct AlongBorder {
    gravity: f64,
    a: f64,
    b: f64,
    speed: f64,
    push: f64,
}

/// The border belongs to the table. Without a wind the puck stays on it, and of a wind only the side counts to which it blows.
#[test]
fn what_slides_along_a_border_is_on_the_table_until_it_is_blown_off() {
    for (a, b, speed) in [
        (0.83, 1.37, 0.6),
        (1.9, -0.57, 1.7),
        (-0.31, 0.77, 2.3),
        (-1.43, -1.21, 0.4),
    ] {
        for side in [0.0, 0.7, -0.7] {
            let push = side * f64::signum(a);
            let scene = AlongBorder {
                gravity: G,
                a,
                b,
                speed,
                push,
            };
            let fallen = if side > 0.0 { G / 2.0 * 4.0 } else { 0.0 };
            for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
                let what = format!("{scene:?} by {method} at {tolerance:e}");
                let start = scene.at(AlongBorder::SLIDES);
                let run = run_by(&scene, (method, tolerance), start, 2.0);
                let State { q, .. } = run.final_state();
                let bound = (100.0 * tolerance).max(1e-11);
                agree(&what, q[0], 1.0 / a + 2.0 * speed * b + 2.0 * push, bound);
                agree(&what, q[1], -2.0 * speed * a, bound);
                agree(&what, q[2], -fallen, bound);
                certified(&what, &run);
            }
        }
    }
}

/// A mass in a round track that reaches from side to side, where it touches the edge, and no farther.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(track: sqrt(x^2 + (y - radius)^2) <= radius, where x >= -radius),
)]
struct Track {
    radius: f64,
    gravity: f64,
}

/// Fast enough it stays on the track for ever, with v² = v₀² − 2 g y.
#[test]
fn an_edge_that_is_only_touched_is_not_left() {
    for (method, tolerance) in methods_at(["taylor", "auto", "dop853", "verner98"], TOLERANCES) {
        let mut random = Random::new(53);
        for k in 0..20 {
            let radius = random.between(0.3, 3.0);
            let scene = Track {
                radius,
                gravity: 9.81,
            };
            let speed = (random.between(5.2, 9.0) * 9.81 * radius).sqrt();
            let start = state(&[0.0; 2], &[-speed, 0.0]);
            let run = run_by(&scene, (method, tolerance), start, 10.0 * radius / speed);
            let asked = format!("{method} {tolerance:e}, {k}");
            assert_eq!(words(&run).len(), 0, "{asked}: {:?}", words(&run));
            let end = run.final_state();
            let square = end.v[0].powi(2) + end.v[1].powi(2);
            let expected = speed * speed - 2.0 * 9.81 * end.q[1];
            agree(asked, square / expected, 1.0, 1e3 * tolerance);
        }
    }
}
