//! Bodies that have nothing to do with one another, in one scene: each moves as it would alone, whatever happens to the others at the same instant.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, certified, event, methods_at, run_by, times};

/// Two balls over a floor each.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*(x + y),
    contact(first: x >= 0, restitution = a),
    contact(second: y >= 0, restitution = b),
)]
struct Balls {
    gravity: f64,
    a: f64,
    b: f64,
}

/// (1 + e)/(1 − e) is odd for e = 1/2, 3/4, 4/5 and 9/10: the instant at which one ball comes to rest is one at which an elastic one from the same height hits.
#[test]
fn a_ball_that_comes_to_rest_leaves_another_one_alone_that_hits_at_that_instant() {
    for (gravity, a, height) in [
        (9.81, 0.8, 0.5),
        (9.81, 0.75, 1.0),
        (10.0, 0.9, 0.5),
        (9.81, 0.5, 1.3),
    ] {
        let balls = Balls { gravity, a, b: 1.0 };
        let falls = (2.0_f64 * height / gravity).sqrt();
        let rest = falls * (1.0 + a) / (1.0 - a);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            for later in [0.0, 1e-10, -1e-10, 1e-9] {
                let what = format!("{balls:?} {later:e} by {method} at {tolerance:e}");
                let start = state(&[height, height + later], &[0.0; 2]);
                let end = rest + 0.7 * falls;
                let motion = run_by(&balls, (method, tolerance), start, end);
                let limit = event(&motion, "first", "closed").time;
                let State { q, v, .. } = motion.final_state();
                // It has bounced 0.7 of a fall ago.
                let speed = (2.0 * gravity * height).sqrt();
                let allowed = 1e3 * tolerance.max(f64::abs(later));
                agree(&what, limit, rest, allowed);
                agree(&what, q[0], 0.0, allowed);
                agree(&what, v[1], speed * 0.3, allowed);
                agree(&what, q[1], height * (1.0 - 0.3 * 0.3), allowed);
                certified(&what, &motion);
            }
        }
    }
}

/// The first and only impact of a body is not one of a train of another one.
#[test]
fn a_first_impact_is_not_the_last_one_of_another_body() {
    let balls = Balls {
        gravity: 9.81,
        a: 0.8,
        b: 0.5,
    };
    let rest = (2.0_f64 * 0.5 / 9.81).sqrt() * 9.0;
    let height = 9.81 / 2.0 * rest * rest;
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let what = format!("by {method} at {tolerance:e}");
        let start = state(&[0.5, height], &[0.0; 2]);
        let motion = run_by(&balls, (method, tolerance), start, rest + 0.5);
        let speed = 0.5 * 9.81 * rest;
        let State { q, v, .. } = motion.final_state();
        agree(&what, v[1], speed - 9.81 * 0.5, 1e3 * tolerance);
        agree(&what, q[1], speed * 0.5 - 9.81 * 0.125, 1e3 * tolerance);
    }
}

/// A rod that strikes a rough floor with a restitution that would add energy (Kane & Levinson 1985), and a ball at a wall of its own.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn, z),
    define(end_x = x + cos(turn)/2, end_y = y + sin(turn)/2),
    kinetic = (der(x)^2 + der(y)^2)/2 + inertia/2*der(turn)^2 + der(z)^2/2,
    contact(floor: end_y >= 0, restitution = 1),
    contact(wall: z >= 0, restitution = e),
    friction(rough on floor: slip = der(end_x), static = mu),
)]
struct Striking {
    inertia: f64,
    mu: f64,
    e: f64,
}

/// What one impact lets go of its restitution, so that it adds no energy, is no matter of the other one: neither does an elastic ball lose speed, nor does a
/// plastic one pay for the energy that the rod would gain.
#[test]
fn impacts_at_one_instant_have_each_their_own_energy() {
    for (inertia, mu, e) in [
        (1.0 / 12.0, 0.7, 0.0),
        (1.0 / 12.0, 0.7, 1.0),
        (0.06, 0.5, 0.4),
        (0.1, 0.9, 1.0),
    ] {
        for turn in [-1.0_f64, -0.9, -2.0] {
            let rod = Striking { inertia, mu, e };
            let what = format!("{rod:?} at {turn}");
            let start = |z: f64| {
                let height = -turn.sin() / 2.0;
                state(&[0.0, height, turn, z], &[0.2, -1.0, -2.0, -1.0])
            };
            let (both, alone) = (start(0.0), start(10.0));
            let [both, alone] = [both, alone].map(|start| {
                let run = run_by(&rod, (METHODS[0], 1e-9), start, 1e-3);
                run.final_state().clone()
            });
            agree(&what, both.v[3], e, 1e-12);
            for j in 0..3 {
                agree(&what, both.v[j], alone.v[j], 1e-9);
            }
            let energy = |v: &[f64]| (v[0] * v[0] + v[1] * v[1] + inertia * v[2] * v[2]) / 2.0;
            let before = energy(&[0.2, -1.0, -2.0]);
            assert!(energy(&both.v) <= before * (1.0 + 1e-9), "{what}");
        }
    }
}

/// Three boxes in the plane, on two feet each, pushed each by a force that grows: 4 096 modes at one instant, and only 16 of each box.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[3], y[3], turn[3]),
    define(
        left[k in 0..3] = y[k] - turn[k]*wide - tall,
        right[k in 0..3] = y[k] + turn[k]*wide - tall,
    ),
    kinetic = sum(k in 0..3: (der(x[k])^2 + der(y[k])^2)/2 + der(turn[k])^2/8),
    potential = sum(k in 0..3: 10*y[k]),
    contact(heel[k in 0..3]: left[k] >= 0),
    contact(toe[k in 0..3]: right[k] >= 0),
    friction(rear[k in 0..3] on heel[k]: slip = der(x[k]), static = mu, kinetic = rub),
    friction(front[k in 0..3] on toe[k]: slip = der(x[k]), static = mu, kinetic = rub),
    force(push[k in 0..3]: x[k] = grows[k]*t),
    start(rest: y[k in 0..3] = tall),
)]
struct Boxes {
    wide: f64,
    tall: f64,
    mu: f64,
    rub: f64,
    grows: [f64; 3],
}

/// Each begins to slide when its own push is larger than its friction, and no other one is told anything then.
#[test]
fn boxes_begin_to_slide_one_by_one() {
    for grows in [
        [0.9, 2.0, 3.0],
        [2.0, 2.0, 2.0],
        [5.0, 0.0, 1.2],
        [0.0, 0.0, 4.0],
    ] {
        let boxes = Boxes {
            wide: 0.4,
            tall: 0.3,
            mu: 0.3,
            rub: 0.2,
            grows,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{grows:?} by {method} at {tolerance:e}");
            let run = run_by(&boxes, (method, tolerance), boxes.at(Boxes::REST), 3.0);
            let State { q, .. } = run.final_state();
            for (k, grows) in grows.into_iter().enumerate() {
                let begins = boxes.mu * 10.0 / grows;
                let lost = ["heel", "toe"].map(|name| times(&run, &format!("{name}[{k}]"), "lost"));
                assert!(lost.iter().all(Vec::is_empty), "{what}");
                // ẍ = grows·t − rub·g.
                let cubic = |t: f64| grows * t * t * t / 6.0 - boxes.rub * 5.0 * t * t;
                let speed = grows * begins * begins / 2.0 - boxes.rub * 10.0 * begins;
                let goes = match begins < 3.0 {
                    true => cubic(3.0) - cubic(begins) - speed * (3.0 - begins),
                    false => 0.0,
                };
                agree(&what, q[k], goes, 100.0 * tolerance);
                for name in ["rear", "front"] {
                    let slips = times(&run, &format!("{name}[{k}]"), "slips");
                    match begins < 3.0 {
                        true => agree(&what, slips[0], begins, 100.0 * tolerance),
                        false => assert!(slips.is_empty(), "{what}"),
                    }
                }
            }
            certified(&what, &run);
        }
    }
}

/// Two bobs on rods that just touch a floor each as they swing through.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[2], y[2]),
    kinetic = sum(k in 0..2: (der(x[k])^2 + der(y[k])^2)/2),
    potential = sum(k in 0..2: gravity*y[k]),
    constraint(rod[k in 0..2]: x[k]^2 + y[k]^2 == length^2),
    contact(floor[k in 0..2]: y[k] >= -length, restitution = bounce),
)]
struct Bobs {
    gravity: f64,
    length: f64,
    bounce: f64,
}

/// What has just touched its floor goes on touching it when the other one comes to its own within rounding: each swings as without floors, by the energy that it
/// has.
#[test]
fn bobs_that_touch_their_floors_almost_at_once_swing_on() {
    for (length, angle, apart, bounce) in [
        (1.3, 0.7, 1e-9, 0.0),
        (0.8, -0.5, 1e-8, 0.6),
        (1.0, 1.1, -1e-7, 0.3),
        (2.1, 0.9, 1e-6, 0.8),
    ] {
        let bobs = Bobs {
            gravity: 9.81,
            length,
            bounce,
        };
        let angles = [angle, angle + apart];
        let at = |of: fn(f64) -> f64| angles.map(|angle: f64| length * of(angle));
        let (x, y) = (at(f64::sin), at(f64::cos));
        let q = [x[0], x[1], -y[0], -y[1]];
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{bobs:?} {angle} {apart:e} by {method} at {tolerance:e}");
            let motion = run_by(&bobs, (method, tolerance), state(&q, &[0.0; 4]), 4.0);
            assert!(motion.events().is_empty(), "{what}");
            let State { q, v, .. } = motion.final_state();
            for k in 0..2 {
                let kinetic = (v[k] * v[k] + v[k + 2] * v[k + 2]) / 2.0;
                let energy = kinetic + bobs.gravity * (q[k + 2] + y[k]);
                agree(&what, energy, 0.0, 1e3 * tolerance);
            }
            certified(&what, &motion);
        }
    }
}
