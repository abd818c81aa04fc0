//! Coordinates that are counted from far away, and gaps that are far larger than what they are measured by: what rounding leaves of forces and gaps is
//! no motion.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, event, run_by, words};

/// A block lies on a plate that a spring holds and a force shakes; all is counted from an origin.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(plate, block),
    kinetic = 2/2*der(plate)^2 + 1/2*der(block)^2,
    potential = stiffness/2*(plate - origin)^2 + 9.81*(block - origin),
    force(drive: plate = 15*sin(rate*t)),
    contact(rests: block - plate >= 0),
)]
struct Shaken {
    stiffness: f64,
    rate: f64,
    origin: f64,
}

#[test]
fn a_block_leaves_its_plate_wherever_that_is_counted_from() {
    for (stiffness, rate) in [(100.0, 6.0), (130.0, 6.5), (80.0, 5.3)] {
        let leaves = |origin: f64, tolerance: f64| {
            let scene = Shaken {
                stiffness,
                rate,
                origin,
            };
            let start = state(&[origin; 2], &[0.0; 2]);
            let run = run_by(&scene, ("auto", tolerance), start, 3.0);
            event(&run, "rests", "lost").time
        };
        let expected = leaves(0.0, 1e-12);
        for (origin, tolerance) in [(1e4, 1e-13), (1e5, 1e-12), (1e5, 1e-13), (1e6, 1e-12)] {
            let what = format!("{stiffness} {rate} from {origin:e} at {tolerance:e}");
            // A position is known to a unit in its last place.
            let known = 1e3 * f64::EPSILON * origin;
            agree(what, leaves(origin, tolerance), expected, known);
        }
    }
}

/// A pendulum as long as a country is wide, beside a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(angle),
    define(x = length*sin(angle), y = -length*cos(angle)),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = 9.81*y,
    contact(wall: x >= -away, restitution = 0.5),
)]
struct Long {
    length: f64,
    away: f64,
}

#[test]
fn a_pendulum_of_a_thousand_kilometres_meets_its_wall() {
    let mut random = Random::new(23);
    for case in 0..200 {
        let scene = Long {
            length: 1e6,
            away: random.between(1e5, 4e5),
        };
        let from = random.between(0.5, 1.2);
        let meets = -(scene.away / scene.length).asin();
        let speed = (2.0 * 9.81 / scene.length * (meets.cos() - from.cos())).sqrt();
        for tolerance in [1e-6, 1e-9] {
            let start = state(&[from], &[0.0]);
            let run = run_by(&scene, ("auto", tolerance), start, 1500.0);
            let what = format!("{case}: {scene:?} from {from} at {tolerance:e}");
            let hit = event(&run, "wall", "impact");
            agree(&what, hit.state.q[0], meets, 10.0 * tolerance);
            agree(&what, hit.state.v[0], -speed, 10.0 * tolerance);
        }
    }
}

/// A mass that is driven against a wall of spring and damper, which is counted from an origin.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    force(drive: x = strength*sin(rate*t) - 16*(x - origin)),
    force(wall: x = -max(0, stiffness*(x - origin) + damping*der(x))),
    mark(changes: der(der(x))),
)]
struct Buffer {
    strength: f64,
    rate: f64,
    stiffness: f64,
    damping: f64,
    origin: f64,
}

/// What rounding of the position makes of the force that says when the wall lets go is no reason for shorter steps.
#[test]
fn a_stiff_wall_is_left_wherever_it_is_counted_from() {
    for (method, tolerance) in [("auto", 1e-9), ("auto", 1e-12), ("taylor", 1e-9)] {
        let mut random = Random::new(29);
        for k in 0..12 {
            let drawn = Buffer {
                strength: random.between(15.0, 40.0),
                rate: random.between(2.0, 5.0),
                stiffness: 10.0_f64.powf(random.between(4.0, 6.0)),
                damping: 10.0_f64.powf(random.between(2.0, 3.4)),
                origin: 0.0,
            };
            let far = random.between(0.3, 5.0);
            let [here, there] = [0.0, far].map(|origin| {
                let scene = Buffer {
                    origin,
                    ..drawn.clone()
                };
                let simulation = Simulation::new(&scene).tolerance(tolerance).max_steps(5000);
                let simulation = simulation.method(method.parse::<Method>().expect("a method"));
                let run = simulation.run(state(&[origin - 0.01], &[0.0]), 0.0..3.0);
                let run =
                    run.unwrap_or_else(|failure| panic!("{method} {tolerance:e}, {k}: {failure}"));
                let end = run.final_state();
                [end.q[0] - origin, end.v[0]]
            });
            let asked = format!("{method} {tolerance:e}, {k}");
            agree(&asked, there[0], here[0], 1e4 * tolerance);
            agree(&asked, there[1], here[1], 1e5 * tolerance);
        }
    }
}

/// A block that is pulled harder than its friction holds.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(pull: x = 1),
    friction(grip: slip = der(x), limit = (0.5, 0.4)),
)]
struct Pulled {}

/// What a short step moves it by at first is less than rounding of where it is.
#[test]
fn a_slow_beginning_is_seen_far_from_the_origin() {
    for (method, until, x) in [
        ("rk4:1e-9", 1e-8, 0.3),
        ("gauss6:1e-9", 1e-8, 0.3),
        ("rk4:1e-7", 1e-6, 100.0),
        ("gauss6:1e-7", 1e-6, 100.0),
        ("rk4:1e-5", 1e-4, 1e6),
    ] {
        let record = run_by(&Pulled {}, (method, 1e-9), state(&[x], &[0.0]), until);
        agree(method, record.final_state().v[0], 0.6 * until, 1e-9 * until);
        assert_eq!(words(&record), ["grip slips"], "{method}");
    }
}
