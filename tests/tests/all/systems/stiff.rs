//! Steps that are bounded by stability are noticed, and by default made by another method.

use super::state;
use crate::sensitivity::Slopes;
use lagrange_core::prelude::*;
use lagrange_problems::catalogue::{HARD, SCENES};
use lagrange_program::request::Request;
use lagrange_tests::{agree, certified};

/// A mass in a damper, driven by a spring, in front of a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = stiffness/2 * (x - sin(t))^2,
    dissipation(damper: damping/2 * der(x)^2),
    contact(wall: x <= place, restitution = 0.5),
)]
struct Coupler<T = f64> {
    mass: T,
    stiffness: T,
    damping: T,
    place: T,
}

const COUPLER: Coupler = Coupler {
    mass: 1e-2,
    stiffness: 1e6,
    damping: 2e3,
    place: 2.0,
};

/// The motion once both decays are over, m ẍ + c ẋ + k x = k sin t, and its rate.
fn steady(scene: &Coupler, t: f64) -> [f64; 2] {
    let (k, c) = (scene.stiffness, scene.damping);
    let p = k - scene.mass;
    let size = k / (p * p + c * c);
    let (sin, cos) = t.sin_cos();
    [size * (p * sin - c * cos), size * (p * cos + c * sin)]
}

fn run(method: Method, tolerance: f64, until: f64) -> Trajectory {
    let simulation = Simulation::new(&COUPLER)
        .method(method)
        .tolerance(tolerance);
    let outcome = simulation.run(state(&[0.5], &[0.0]), 0.0..until);
    outcome.expect("a run")
}

#[test]
fn a_stiff_coupler_follows_its_drive() {
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        let trajectory = run(Method::Auto, tolerance, 10.0);
        let [x, v] = steady(&COUPLER, 10.0);
        let end = trajectory.final_state();
        let error = (end.q[0] - x).abs().max((end.v[0] - v).abs());
        assert!(error < 10.0 * tolerance, "{tolerance:e}: {error:e}");
        let [stiff] = trajectory.stiff() else {
            panic!("{:?}", trajectory.stiff())
        };
        assert!(stiff.start < 0.2 && stiff.end == 10.0, "{stiff:?}");
        certified("", &trajectory);
    }
}

#[test]
fn sensitivities_pass_through_the_change_of_method() {
    let number = Slopes::constant;
    let scene = Coupler {
        mass: number(COUPLER.mass),
        stiffness: number(COUPLER.stiffness),
        damping: Slopes::variable(COUPLER.damping, 0),
        place: number(COUPLER.place),
    };
    let start = State::new(vec![number(0.5)], vec![number(0.0)]);
    let outcome = Simulation::new(&scene).run(start, 0.0..3.0);
    let trajectory = outcome.expect("a run");
    assert_eq!(trajectory.stiff().len(), 1);
    let at = |damping: f64| steady(&Coupler { damping, ..COUPLER }, 3.0)[0];
    let c = COUPLER.damping;
    let slope = (at(1.01 * c) - at(0.99 * c)) / (0.02 * c);
    let found = trajectory.final_state().q[0].derivative[0];
    agree("dx/dc", found, slope, 1e-4);
}

#[test]
fn explicit_methods_say_that_stability_bounds_their_steps() {
    for method in [
        Method::Taylor,
        Method::DormandPrince853,
        Method::DormandPrince54,
        Method::Verner98,
    ] {
        let trajectory = run(method, 1e-6, 1.0);
        assert_eq!(trajectory.stiff().len(), 1, "{method}");
        let few = run(Method::Auto, 1e-6, 1.0).work().steps;
        assert!(trajectory.work().steps > 4 * few, "{method}");
    }
    assert!(run(Method::Radau5, 1e-6, 1.0).stiff().is_empty());
}

#[test]
fn an_impact_begins_anew_with_taylor_series() {
    let scene = Coupler {
        place: 0.9,
        ..COUPLER
    };
    let hit = |method: Method| {
        let simulation = Simulation::new(&scene).method(method).tolerance(1e-10);
        let outcome = simulation.run(state(&[0.5], &[0.0]), 0.0..6.0);
        outcome.unwrap_or_else(|failure| panic!("{method}: {failure}"))
    };
    let (auto, taylor) = (hit(Method::Auto), hit(Method::Taylor));
    assert!(auto.stiff().len() > 1, "{:?}", auto.stiff());
    assert_eq!(auto.events().len(), taylor.events().len());
    for (a, b) in auto.events().iter().zip(taylor.events()) {
        assert_eq!(a.kind.word(), b.kind.word());
        assert!((a.time - b.time).abs() < 1e-8, "{} {}", a.time, b.time);
    }
    for stiff in auto.stiff() {
        let events = auto.events().iter();
        let within = events.filter(|e| stiff.start < e.time && e.time < stiff.end);
        assert_eq!(within.count(), 0, "{stiff:?}");
    }
}

#[test]
fn only_one_scene_of_the_catalogue_is_stiff() {
    for scene in SCENES.iter().chain(HARD) {
        for tolerance in [1e-3, 1e-9] {
            let request = Request {
                tolerance,
                ..Request::default()
            };
            let outcome = scene.run(&request).expect("a request");
            let stiff = scene.name() == "overdamped-oscillator";
            assert_eq!(
                !outcome.stiff.is_empty(),
                stiff,
                "{} {tolerance:e}",
                scene.name()
            );
        }
    }
}

/// A motor on a stiff coupler pushes a carriage that a stop and friction hold together: nothing tells how they share the load.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(motor, carriage),
    kinetic = der(motor)^2 / 2 + der(carriage)^2,
    potential(coupler: stiffness/2 * (motor - carriage)^2),
    dissipation(coupler_damper: stiffness/200 * (der(motor) - der(carriage))^2),
    force(drive: motor = 5 + sin(t)),
    contact(end: carriage <= 0),
    friction(rail: slip = der(carriage), limit = 2),
)]
struct Pushed {
    stiffness: f64,
}

#[test]
fn a_stiff_coupler_at_rest_under_a_shared_load_takes_long_steps() {
    let start = || state(&[0.0; 2], &[0.0; 2]);
    let of = |stiffness: f64| {
        let outcome = Simulation::new(&Pushed { stiffness }).run(start(), 0.0..3.0);
        let trajectory = outcome.expect("a run");
        certified(stiffness, &trajectory);
        trajectory.work().steps
    };
    let steps = [1e5, 1e6, 1e7].map(of);
    assert!(steps.iter().all(|steps| *steps < 1500), "{steps:?}");
}

/// Two masses with a stiff dashpot between them, one of which a belt shakes to and fro.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = 78.0/2 * x^2,
    dissipation(dashpot: damping/2 * (der(x) - der(y))^2),
    friction(belt: slip = der(x) - 0.27*cos(t), limit = (2.5, 1.5)),
    start(aside: x = 1, y = 1),
)]
struct Shaken {
    damping: f64,
}

/// Explicit steps are bounded by stability, and tried in vain; they come to the end all the same.
#[test]
fn explicit_steps_that_are_tried_in_vain_come_to_the_end() {
    for damping in [1.5e4, 4e4] {
        let scene = Shaken { damping };
        let run = |method: Method| {
            let simulation = Simulation::new(&scene).method(method);
            let outcome = simulation.run(scene.at(Shaken::ASIDE), 0.0..1.1);
            outcome.unwrap_or_else(|failure| panic!("{damping}: {failure}"))
        };
        let (expected, found) = (run(Method::Auto), run(Method::DormandPrince853));
        for (found, expected) in found.events().iter().zip(expected.events()) {
            assert_eq!(found.kind, expected.kind);
            agree(damping, found.time, expected.time, 1e-8);
        }
        let ends = found.final_state().q.iter().zip(&expected.final_state().q);
        ends.for_each(|(found, expected)| agree(damping, *found, *expected, 1e-8));
    }
}
