//! Drag that grows with the square of the speed: |v| is a root that begins at zero where a body is let go.
//!
//! Closed forms: v̇ = a − k v² from rest has v = w tanh(a t/w) and s = ln cosh(a t/w)/k with w = √(a/k).

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{SINGLE_METHODS, TOLERANCES, agree, certified, run_by, times};

/// A stone over an inclined floor of friction.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3]: "m"),
    define(v = der([x[0], x[1], x[2]])),
    kinetic = mass/2 * dot(v, v),
    potential = mass * gravity * (x[2] * cos(slope) + x[0] * sin(slope)),
    force(air: -drag * norm(v) * v at [x[0], x[1], x[2]]),
    contact(floor: x[2] >= 0, restitution = 0),
    friction(rub on floor: slip = (der(x[0]), der(x[1])), static = 0.5, kinetic = 0.4),
)]
struct Stone {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "kg/m")]
    drag: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "rad")]
    slope: f64,
}

impl Stone {
    fn on(slope: f64) -> Self {
        Stone {
            mass: 0.7,
            drag: 0.05,
            gravity: 9.81,
            slope,
        }
    }
}

/// The same drag as a dissipation, of a body that nothing else holds.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    dissipation(air: drag/3 * norm(der([x, y]))^3),
)]
struct Falling {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "kg/m")]
    drag: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
}

/// (s, v) a time t after rest.
fn from_rest(acceleration: f64, drag: f64, t: f64) -> (f64, f64) {
    let limit = (acceleration / drag).sqrt();
    let angle = acceleration * t / limit;
    (angle.cosh().ln() / drag, limit * angle.tanh())
}

#[test]
fn a_stone_that_is_let_go_falls_and_lies() {
    let stone = Stone::on(0.0);
    let (depth, speed) = from_rest(stone.gravity, stone.drag / stone.mass, 1.0);
    for method in SINGLE_METHODS {
        let simulation = Simulation::new(&stone).tolerance(1e-11).method(method);
        let run = simulation
            .run(state(&[0.0, 0.0, 8.0], &[0.0; 3]), 0.0..3.0)
            .expect("falls");
        certified(format!("{method:?}"), &run);
        let falling = run.sampler().at(1.0).expect("within").state;
        agree("height", falling.q[2], 8.0 - depth, 1e-9);
        agree("speed", falling.v[2], -speed, 1e-9);
        let end = run.final_state();
        assert_eq!(end.v.as_slice(), [0.0; 3], "{method:?}");
        assert!(end.q[2].abs() < 1e-12, "{method:?}: {}", end.q[2]);
    }
}

/// Both |v| and the direction of the slip begin where nothing moves yet.
#[test]
fn a_stone_that_is_let_go_on_a_steep_slope_slips_at_once() {
    let stone = Stone::on(0.6);
    let pull = stone.gravity * (stone.slope.sin() - 0.4 * stone.slope.cos());
    let (way, speed) = from_rest(pull, stone.drag / stone.mass, 2.0);
    for method in SINGLE_METHODS {
        let simulation = Simulation::new(&stone).tolerance(1e-11).method(method);
        let run = simulation
            .run(state(&[0.0; 3], &[0.0; 3]), 0.0..2.0)
            .expect("slips");
        certified(format!("{method:?}"), &run);
        agree("way", run.final_state().q[0], -way, 1e-9);
        agree("speed", run.final_state().v[0], -speed, 1e-9);
    }
}

#[test]
fn a_stone_on_a_gentle_slope_stays() {
    let stone = Stone::on(0.4);
    let run = Simulation::new(&stone)
        .run(state(&[0.0; 3], &[0.0; 3]), 0.0..5.0)
        .expect("rests");
    assert_eq!(run.final_state().q.as_slice(), [0.0; 3]);
    certified("", &run);
}

#[test]
fn a_dissipation_of_third_order_is_the_same_drag() {
    let body = Falling {
        mass: 0.7,
        drag: 0.05,
        gravity: 9.81,
    };
    let rate = body.drag / body.mass;
    let limit = (body.gravity / rate).sqrt();
    // Thrown upwards: v = w tan(atan(v₀/w) − g t/w) until the top, where the speed is zero again.
    let thrown = 12.0_f64;
    let to_top = (thrown / limit).atan() * limit / body.gravity;
    let top = ((thrown / limit).powi(2) + 1.0).ln() / (2.0 * rate);
    let (depth, speed) = from_rest(body.gravity, rate, 1.0);
    for method in SINGLE_METHODS {
        let simulation = Simulation::new(&body).tolerance(1e-10).method(method);
        let run = simulation
            .run(state(&[0.0, 0.0], &[0.0, thrown]), 0.0..to_top + 1.0)
            .expect("rises and falls");
        certified(format!("{method:?}"), &run);
        agree("height", run.final_state().q[1], top - depth, 1e-8);
        agree("speed", run.final_state().v[1], -speed, 1e-8);
        let fall = simulation
            .run(state(&[0.0, 0.0], &[0.0, 0.0]), 0.0..1.0)
            .expect("falls");
        agree("fall", fall.final_state().q[1], -depth, 1e-9);
    }
}

/// Norton's dome (Causation as folk science, 2003, section 3): on its top a ball may rest, and it may leave at any time.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r: "m"),
    kinetic = mass/2 * der(r)^2,
    potential = -mass * 2/3 * steepness * sqrt(r)^3,
)]
struct Dome {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "m^(1/2)/s^2")]
    steepness: f64,
}

#[test]
fn a_rest_that_is_not_the_only_motion_is_refused() {
    let dome = Dome {
        mass: 1.0,
        steepness: 1.0,
    };
    let refused = Simulation::new(&dome).run(state(&[0.0], &[0.0]), 0.0..1.0);
    let Err(failure) = refused else {
        panic!("it may leave at any time")
    };
    let Error::Singular { items, .. } = failure.error else {
        panic!("{failure}")
    };
    assert_eq!(items, ["r"]);
    // Once it moves, r = (t/c)⁴ with c⁴ = 144.
    let moving = |t: f64| state(&[t.powi(4) / 144.0], &[t.powi(3) / 36.0]);
    let run = Simulation::new(&dome)
        .tolerance(1e-11)
        .run(moving(1.0), 1.0..3.0)
        .expect("leaves");
    agree("r", run.final_state().q[0], moving(3.0).q[0], 1e-9);
}

/// A bead in a round bowl, told by where it is; and by its angle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    define(v = der([x, y]), far = norm([x, y])),
    kinetic = dot(v, v)/2,
    potential = gravity*y,
    force(air: -drag*norm(v)*v at (x, y)),
    contact(bowl: far <= 1),
    friction(rub on bowl: slip = (x*der(y) - y*der(x))/far, static = mu),
    start(side: x = sin(angle), y = -cos(angle)),
)]
struct Bowl {
    gravity: f64,
    drag: f64,
    mu: f64,
    angle: f64,
}

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = der(theta)^2/2,
    potential = -gravity*cos(theta),
    force(air: theta = -drag*abs(der(theta))*der(theta)),
    friction(rub: slip = der(theta), normal = gravity*cos(theta) + der(theta)^2, static = mu),
    start(side: theta = angle),
)]
struct Swing {
    gravity: f64,
    drag: f64,
    mu: f64,
    angle: f64,
}

/// Where it turns both velocities are zero but for rounding, and so is what |v| begins anew with.
#[test]
fn a_bead_turns_on_a_curved_path() {
    for k in 0..8 {
        let (gravity, drag, angle) = (9.81, 0.1, 0.3 + 0.07 * f64::from(k));
        let mu = if k % 2 == 0 { 0.02 } else { 0.05 };
        let bowl = Bowl {
            gravity,
            drag,
            mu,
            angle,
        };
        let swing = Swing {
            gravity,
            drag,
            mu,
            angle,
        };
        let by_angle = run_by(&swing, ("dop853", 1e-12), swing.at(Swing::SIDE), 5.0);
        let turns = times(&by_angle, "rub", "reverses");
        assert!(turns.len() > 1, "{turns:?}");
        for (method, tolerance) in [
            ("taylor", 1e-6),
            ("taylor", 1e-9),
            ("taylor", 1e-12),
            ("dop853", 1e-9),
        ] {
            let run = run_by(&bowl, (method, tolerance), bowl.at(Bowl::SIDE), 5.0);
            let found = times(&run, "rub", "reverses");
            assert_eq!(found.len(), turns.len(), "{method} {tolerance:e} {angle}");
            for (found, turn) in found.iter().zip(&turns) {
                agree(method, *found, *turn, 50.0 * tolerance.max(1e-11));
            }
            certified(format!("{method} {tolerance:e} {angle}"), &run);
        }
    }
}

/// A bead on a wire whose speed falls below zero and comes back; and the same by its one speed.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    define(v = der([cos(x), sin(x)])),
    kinetic = der(x)^2/2,
    force(push: x = 2*(t - 1)),
    force(air: -drag*norm(v)*v at [cos(x), sin(x)]),
    start(runs: der(x) = 1 - dip),
)]
struct Bead {
    drag: f64,
    dip: f64,
}

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    force(push: x = 2*(t - 1)),
    force(air: x = -drag*abs(der(x))*der(x)),
    start(runs: der(x) = 1 - dip),
)]
struct Speed {
    drag: f64,
    dip: f64,
}

/// Between the zeros the series of |v| has the wrong sign, and at the end of a step that reaches beyond both the right one.
#[test]
fn a_speed_that_passes_zero_twice_is_slowed_all_the_way() {
    for (drag, dip) in [
        (1e-3, 0.1),
        (1e-3, 0.3),
        (0.1, 0.1),
        (0.1, 0.01),
        (1.0, 0.3),
    ] {
        let speed = Speed { drag, dip };
        let known = run_by(&speed, ("dop853", 1e-13), speed.at(Speed::RUNS), 3.0);
        let bead = Bead { drag, dip };
        for tolerance in TOLERANCES {
            let run = run_by(&bead, ("taylor", tolerance), bead.at(Bead::RUNS), 3.0);
            let asked = format!("{drag} {dip} {tolerance:e}");
            let [found, known] = [&run, &known].map(|run| run.final_state().q[0]);
            agree(&asked, found, known, 100.0 * tolerance);
            certified(asked, &run);
        }
    }
}
