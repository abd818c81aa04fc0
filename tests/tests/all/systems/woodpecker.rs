//! The woodpecker toy: a bird on a spring pecks at its pole, and its sleeve sticks to it and slips down.
//!
//! Model, parameters and the state on the limit cycle: Leine, van Campen & Glocker, "Nonlinear dynamics and modeling of various
//! wooden toys with impact and friction", Journal of Vibration and Control 9 (2003), section 4.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, certified};

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y: "m", sleeve: "rad", bird: "rad"),
    define(sleeve_mass = 0.3 * gram, bird_mass = 4.5 * gram),
    kinetic = (sleeve_mass + bird_mass)/2 * der(y)^2
        + (sleeve_inertia + bird_mass * arm^2)/2 * der(sleeve)^2 + (bird_inertia + bird_mass * neck^2)/2 * der(bird)^2
        + bird_mass * (arm * der(y) * der(sleeve) + neck * der(y) * der(bird) + arm * neck * der(sleeve) * der(bird)),
    potential = (sleeve_mass + bird_mass) * gravity * y + spring/2 * (sleeve - bird)^2
        + bird_mass * gravity * (arm * sleeve + neck * bird),
    contact(beak: arm + neck - reach - pole >= beak_height * bird, restitution = 0.5),
    contact(lower: hole - pole + height * sleeve >= 0, restitution = 0),
    contact(upper: hole - pole >= height * sleeve, restitution = 0),
    friction(at_beak on beak: slip = der(y) + arm * der(sleeve) + (neck - reach) * der(bird), static = mu),
    friction(at_lower on lower: slip = der(y) + hole * der(sleeve), static = mu),
    friction(at_upper on upper: slip = der(y) + hole * der(sleeve), static = mu),
)]
struct Woodpecker {
    #[lagrange(unit = "kg")]
    gram: f64,
    #[lagrange(unit = "kg m^2")]
    sleeve_inertia: f64,
    #[lagrange(unit = "kg m^2")]
    bird_inertia: f64,
    #[lagrange(unit = "N m")]
    spring: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "m")]
    arm: f64,
    #[lagrange(unit = "m")]
    neck: f64,
    #[lagrange(unit = "m")]
    reach: f64,
    #[lagrange(unit = "m")]
    height: f64,
    #[lagrange(unit = "m")]
    beak_height: f64,
    #[lagrange(unit = "m")]
    pole: f64,
    #[lagrange(unit = "m")]
    hole: f64,
    mu: f64,
}

impl Default for Woodpecker {
    fn default() -> Self {
        Self {
            gram: 0.001,
            sleeve_inertia: 5e-9,
            bird_inertia: 7e-7,
            spring: 0.0056,
            gravity: 9.81,
            arm: 0.010,
            neck: 0.015,
            reach: 0.0201,
            height: 0.0058,
            beak_height: 0.020,
            pole: 0.0025,
            hole: 0.0031,
            mu: 0.3,
        }
    }
}

impl Woodpecker {
    /// The published state at the beginning of the cycle, of four digits: its sleeve is 0.9 µm inside the pole.
    fn published() -> State {
        state(&[0.0, -0.1036, -0.2788], &[-0.3411, 0.0, -7.4583])
    }
}

#[test]
fn the_woodpecker_comes_back_to_its_cycle() {
    let toy = Woodpecker::default();
    let mut ends = Vec::new();
    for method in [Method::Taylor, Method::DormandPrince853] {
        let simulation = Simulation::new(&toy).tolerance(1e-11).method(method);
        let run = simulation
            .project_start(true)
            .run(Woodpecker::published(), 0.0..20.0)
            .expect("pecks on");
        certified("", &run);
        let pecks: Vec<_> = run
            .events()
            .iter()
            .filter(|e| e.impulse(Woodpecker::BEAK) > 0.0)
            .collect();
        let period = |k: usize| pecks[pecks.len() - k].time - pecks[pecks.len() - k - 1].time;
        agree("period", period(1), period(2), 1e-8);
        // The bird is where it was a cycle ago, lower down.
        let state = |k: usize| &pecks[pecks.len() - k].state;
        agree("posture", state(1).q[1], state(2).q[1], 1e-8);
        agree("swing", state(1).v[2], state(2).v[2], 1e-8);
        ends.push((period(1), state(1).q[0] - state(2).q[0]));
    }
    agree("period", ends[0].0, ends[1].0, 1e-9);
    agree("descent", ends[0].1, ends[1].1, 1e-9);
}

#[test]
fn a_start_below_a_surface_is_moved_onto_it() {
    let toy = Woodpecker::default();
    let simulation = Simulation::new(&toy).tolerance(1e-10);
    let refused = simulation.run(Woodpecker::published(), 0.0..0.01);
    let Err(failure) = refused else {
        panic!("it begins inside the pole")
    };
    assert!(
        matches!(failure.error, Error::Penetrates { item: "lower", .. }),
        "{failure}"
    );
    assert!(
        failure.to_string().contains("project_start(true)"),
        "{failure}"
    );

    let run = simulation
        .project_start(true)
        .run(Woodpecker::published(), 0.0..0.01)
        .expect("moved");
    let start = run.sampler().at(0.0).expect("the start");
    // (r₀ − r_M)/h_M
    agree(
        "sleeve",
        start.q(Woodpecker::SLEEVE),
        -0.0006 / 0.0058,
        1e-14,
    );
    assert_eq!(
        start.state.v.as_slice(),
        Woodpecker::published().v.as_slice()
    );
    assert!(
        run.events().iter().all(|event| event.time > 0.0),
        "{:?}",
        run.events()
    );
}

/// A box that was put through the floor: both corners come out of it, and what it does then is certified.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    kinetic = (der(x)^2 + der(y)^2)/2 + der(phi)^2/40,
    potential = 9.81 * y,
    contact(right: y + 0.3 * sin(phi) - 0.2 * cos(phi) >= 0, restitution = 0.3),
    contact(left: y - 0.3 * sin(phi) - 0.2 * cos(phi) >= 0, restitution = 0.3),
    contact(wall: x >= depth + 0.3 * cos(phi) + 0.2 * sin(phi)),
)]
struct Sunk {
    depth: f64,
}

#[test]
fn what_leaves_one_surface_may_not_end_below_another() {
    let sunk = Sunk { depth: 0.0 };
    // What arrives at the floor bounces from it at once.
    for (q, speed, after) in [
        ([0.4, 0.1, 0.3], -0.5, 0.15),
        ([0.1, -3.0, 0.1], 0.5, 0.5),
        ([-2.0, 0.1, 0.0], 0.0, 0.0),
    ] {
        let start = state(&q, &[0.0, speed, 0.0]);
        let simulation = Simulation::new(&sunk).tolerance(1e-10).project_start(true);
        let run = simulation.run(start, 0.0..1.0).expect("moved");
        certified("", &run);
        let start = run.sampler().at(0.0).expect("the start");
        let [x, y, phi] = [0, 1, 2].map(|j| start.state.q[j]);
        let gaps = [0.3, -0.3].map(|arm| y + arm * phi.sin() - 0.2 * phi.cos());
        let wall = x - 0.3 * phi.cos() - 0.2 * phi.sin();
        assert!(
            gaps.iter().chain([&wall]).all(|&gap| gap > -1e-9),
            "{gaps:?} {wall}"
        );
        agree("speed", start.state.v[1], after, 1e-12);
    }
}
