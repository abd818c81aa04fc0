//! All modes in which a state can go on, with their forces.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, event, run_by};

const G: f64 = 9.81;

/// A rod that leans and slides on its lower tip (Painlevé 1895), of half length 1 and mass 1.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    define(tip = [x - cos(phi), y - sin(phi)]),
    kinetic = (der(x)^2 + der(y)^2) / 2 + der(phi)^2 / 6,
    potential = gravity * y,
    contact(floor: tip[1] >= 0),
    friction(grip on floor: slip = der(tip[0]), static = mu),
    start(pushed: y = sin(lean), phi = lean, der(x) = speed - rate * sin(lean), der(y) = rate * cos(lean), der(phi) = rate),
)]
struct Rod {
    gravity: f64,
    mu: f64,
    lean: f64,
    speed: f64,
    rate: f64,
}

/// The normal force at the tip that slides in this direction: N (1 + 3 cos φ (cos φ + s μ sin φ)) makes up for the fall of the tip
/// that is free, rate² sin φ − g.
fn normal(rod: &Rod, slides: f64) -> f64 {
    let (sin, cos) = rod.lean.sin_cos();
    let gives = 1.0 + 3.0 * cos * (cos + slides * rod.mu * sin);
    (rod.gravity - rod.rate * rod.rate * sin) / gives
}

#[test]
fn a_rod_that_may_stay_or_fly_off() {
    let rod = Rod {
        gravity: G,
        mu: 1.6,
        lean: 1.0,
        speed: -1.0,
        rate: 4.0,
    };
    let start = rod.at(Rod::PUSHED);
    let modes = Simulation::new(&rod)
        .feasible_modes(0.0, &start)
        .expect("modes");
    assert_eq!(modes.len(), 2);
    let (stays, flies) = (&modes[0], &modes[1]);
    assert!(stays.mode.slips(Rod::GRIP) && !flies.mode.closed(Rod::FLOOR));
    let force = normal(&rod, -1.0);
    agree("N", stays.force(Rod::FLOOR), force, 1e-12);
    agree("friction", stays.force(Rod::GRIP), rod.mu * force, 1e-12);
    agree(
        "turns",
        stays.a(Rod::PHI),
        3.0 * force * (rod.mu * 1_f64.sin() - 1_f64.cos()),
        1e-12,
    );
    assert_eq!(flies.force(Rod::FLOOR), 0.0);
    // The state of a run is on the floor to rounding only.
    let later = start
        .clone()
        .with_q(Rod::X, 700.0)
        .with_q(Rod::Y, 1_f64.sin() - 1e-13);
    let modes = Simulation::new(&rod).feasible_modes(0.0, later);
    assert_eq!(modes.expect("modes").len(), 2);
    agree("falls", flies.a(Rod::Y), -G, 1e-12);
    // A run takes the first.
    let run = Simulation::new(&rod).run(start, 0.0..1e-3).expect("a run");
    assert!(run.events()[0].ambiguous && run.phases()[0].mode == stays.mode);
}

#[test]
fn a_rod_with_one_motion_and_one_with_none() {
    let gentle = Rod {
        gravity: G,
        mu: 0.3,
        lean: 1.0,
        speed: -1.0,
        rate: 0.0,
    };
    let modes = Simulation::new(&gentle)
        .feasible_modes(0.0, gentle.at(Rod::PUSHED))
        .expect("modes");
    assert_eq!(modes.len(), 1);
    agree(
        "N",
        modes[0].force(Rod::FLOOR),
        normal(&gentle, -1.0),
        1e-12,
    );
    let rough = Rod { mu: 1.6, ..gentle };
    let none = Simulation::new(&rough).feasible_modes(0.0, rough.at(Rod::PUSHED));
    assert!(
        matches!(none, Err(Error::NoMode { tried: 2, .. })),
        "{none:?}"
    );
}

/// A beam on three supports, the middle one under its centre of mass.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(left: y - arm * sin(phi) >= 0),
    contact(middle: y >= 0, restitution = bounce),
    contact(right: y + arm * sin(phi) >= 0),
    friction(grip on middle: slip = der(x), static = mu_static, kinetic = mu_kinetic),
    force(pull: x = strength),
    start(lies),
    start(drops: der(y) = -1),
)]
struct Beam {
    mass: f64,
    inertia: f64,
    gravity: f64,
    arm: f64,
    bounce: f64,
    mu_static: f64,
    mu_kinetic: f64,
    strength: f64,
}

const BEAM: Beam = Beam {
    mass: 3.0,
    inertia: 0.5,
    gravity: G,
    arm: 0.8,
    bounce: 0.5,
    mu_static: 0.0,
    mu_kinetic: 0.0,
    strength: 0.0,
};

#[test]
fn supports_too_many() {
    let modes = Simulation::new(&BEAM)
        .feasible_modes(0.0, BEAM.at(Beam::LIES))
        .expect("modes");
    assert_eq!(
        modes.len(),
        1,
        "a support that opens without a gap is no other motion"
    );
    // The shares of least norm are equal, and open.
    for support in [Beam::LEFT, Beam::MIDDLE, Beam::RIGHT] {
        agree("share", modes[0].force(support), BEAM.mass * G / 3.0, 1e-12);
    }
    assert!(modes[0].undetermined[..3].iter().all(|open| *open));
}

#[test]
fn what_sticks_may_slip_too() {
    // The pull lies between kinetic and static friction of any share of the load.
    let beam = Beam {
        mu_static: 3.0,
        mu_kinetic: 0.01,
        strength: 2.0,
        ..BEAM
    };
    let modes = Simulation::new(&beam)
        .feasible_modes(0.0, beam.at(Beam::LIES))
        .expect("modes");
    assert!(modes[0].mode.sticks(Beam::GRIP));
    assert_eq!(modes.len(), 3);
    // The supports share the load, or the one in the middle carries it.
    let weight = beam.mass * G;
    for (mode, load) in modes[1..].iter().zip([weight / 3.0, weight]) {
        assert!(mode.mode.slips(Beam::GRIP));
        agree("load", mode.force(Beam::MIDDLE), load, 1e-12);
        let pull = beam.strength - beam.mu_kinetic * load;
        agree("speeds up", mode.a(Beam::X), pull / beam.mass, 1e-12);
    }
}

#[test]
fn after_an_impact() {
    let modes = Simulation::new(&BEAM)
        .feasible_modes(0.0, BEAM.at(Beam::DROPS))
        .expect("modes");
    assert!(
        modes
            .iter()
            .all(|mode| mode.v(Beam::Y) > 0.0 && !mode.mode.closed(Beam::MIDDLE))
    );
}

#[test]
fn what_is_no_state_is_refused() {
    let below = BEAM.at(Beam::LIES).with_q(Beam::Y, -0.1);
    let refused = Simulation::new(&BEAM).feasible_modes(0.0, &below);
    assert!(
        matches!(refused, Err(Error::Penetrates { .. })),
        "{refused:?}"
    );
}

/// Two blocks, one on the other, of which the upper one is pulled more and more; the frictions in both orders.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, u, y, w),
    kinetic = (der(x)^2 + der(u)^2 + der(y)^2 + der(w)^2)/2,
    force(pull: u = rate * t),
    force(other_pull: w = rate * t),
    friction(floor: slip = der(x), limit = (10, 9)),
    friction(between: slip = der(u) - der(x), limit = (12, 8)),
    friction(other_between: slip = der(w) - der(y), limit = (12, 8)),
    friction(other_floor: slip = der(y), limit = (10, 9)),
)]
struct Stacks {
    rate: f64,
}

/// At 10 N both frictions could slip alone, μₖ < μₛ: it is the one that has been overcome, whatever the order of declaration.
#[test]
fn what_has_been_overcome_lets_go() {
    let stacks = Stacks { rate: 1.0 };
    for method in ["taylor", "dop853", "radau5"] {
        let start = state(&[0.0; 4], &[0.0; 4]);
        let motion = run_by(&stacks, (method, 1e-9), start, 12.0);
        for floor in ["floor", "other_floor"] {
            agree(method, event(&motion, floor, "slips").time, 10.0, 1e-8);
        }
        // Two masses that are pulled with t − 9 for two seconds.
        for speed in &motion.final_state().v {
            agree(method, *speed, (22.0 - 18.0) / 2.0, 1e-8);
        }
    }
}

/// A plank at rest on three feet, its weight aside of them all, in axes that are turned.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    define(height = x * sin(turn) + y * cos(turn)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * (height + aside * phi),
    contact(foot[k in 0..3]: height + (k * step - first) * phi >= 0),
)]
struct ThreeFeet {
    turn: f64,
    mass: f64,
    inertia: f64,
    gravity: f64,
    aside: f64,
    step: f64,
    first: f64,
}

/// It stands on any two feet that its weight is between, and on all three: all of that is one motion, rest, whatever rounding makes of its accelerations.
#[test]
fn a_body_at_rest_goes_on_in_one_mode() {
    let mut random = Random::new(65);
    for _ in 0..50 {
        let first = random.between(0.1, 0.3);
        let scene = ThreeFeet {
            turn: random.between(0.1, 1.4),
            mass: random.between(0.1, 3.0),
            inertia: random.between(0.01, 1.0),
            gravity: 9.81,
            aside: random.between(-0.5, 0.5) * first,
            step: random.between(0.2, 0.4) + first,
            first,
        };
        let modes = Simulation::new(&scene).feasible_modes(0.0, state(&[0.0; 3], &[0.0; 3]));
        let modes = modes.expect("a mode");
        assert_eq!(modes.len(), 1, "{scene:?}");
        let weight: f64 = modes[0].forces.iter().map(|force| force.abs()).sum();
        agree("weight", weight, scene.mass * scene.gravity, 1e-12);
    }
}
