//! Every method of integration tells the same story: the same events at the same instants, stops and marks included.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;
use lagrange_tests::{agree, words};

/// Runs a scene from its first start by each method and compares with the Taylor method at 1e-14.
fn check<S: Derived<Scalar = f64> + Default>(until: f64) {
    let scene = S::default();
    let n = S::DESCRIPTION.coordinates.len();
    let mut start = State::new(vec![0.0; n], vec![0.0; n]);
    scene.start(0, 0.0, &mut start.q, &mut start.v);
    let run = |method: Method, tolerance| {
        let outcome = Simulation::new(&scene)
            .method(method)
            .tolerance(tolerance)
            .run(start.clone(), 0.0..until);
        outcome.unwrap_or_else(|failure| panic!("{method}: {failure}"))
    };
    let reference = run(Method::Taylor, 1e-14);
    for method in [
        Method::DormandPrince853,
        Method::DormandPrince54,
        Method::Verner98,
        Method::Radau5,
        Method::Gauss6 { step: 0.005 },
    ] {
        let trajectory = run(method, 1e-11);
        assert_eq!(words(&trajectory), words(&reference), "{method}");
        for (event, exact) in trajectory.events().iter().zip(reference.events()) {
            let what = format!("{method}, time of an event");
            agree(&what, event.time, exact.time, 1e-8);
        }
        let states = trajectory.final_state().q.iter();
        for (q, exact) in states.zip(&reference.final_state().q) {
            agree(format!("{method}, final state"), *q, *exact, 1e-8);
        }
    }
}

#[test]
fn all_methods_agree_on_the_mass_on_the_shell() {
    check::<MassOnShell>(10.0);
}

#[test]
fn all_methods_agree_on_the_rolling_sphere() {
    check::<RollingSphere>(10.0);
}

#[test]
fn all_methods_agree_on_the_sphere_that_slips() {
    check::<RollingSlippingSphere>(10.0);
}

#[test]
fn all_methods_agree_on_the_mass_on_the_wheel() {
    check::<MassOnWheel>(10.0);
}

#[test]
fn all_methods_agree_on_the_sphere_in_the_bowl() {
    check::<SphereInBowl>(3.0);
}

#[test]
fn every_method_turns_a_body_in_quaternions() {
    // Close to the identity a diagonal minor of the singular mass matrix nearly vanishes: what elimination without row
    // exchanges loses there must not pass for a pivot.
    let body = lagrange_problems::scenes::hard::TumblingBody::default();
    let start = State::new(
        vec![1.0, 0.0, 0.0, 0.0],
        vec![0.0, 0.5 * body.nudge, 0.5 * body.rate, 0.0],
    );
    let turned = |method| {
        let simulation = Simulation::new(&body).method(method).tolerance(1e-9);
        simulation.run(start.clone(), 0.0..10.0).expect("runs")
    };
    let reference = turned(Method::Taylor);
    for (method, steps) in [
        (Method::DormandPrince853, 60),
        (Method::DormandPrince54, 300),
        (Method::Verner98, 60),
        (Method::Radau5, 900),
    ] {
        let trajectory = turned(method);
        let error = worst(trajectory.final_state(), reference.final_state());
        assert!(error < 1e-6, "{method}: {error:e}");
        assert!(
            trajectory.work().steps < steps,
            "{method}: {} steps",
            trajectory.work().steps
        );
    }
}

fn worst(a: &State<f64>, b: &State<f64>) -> f64 {
    let pairs = a.q.iter().zip(&b.q);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
