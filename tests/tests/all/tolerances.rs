//! Absolute tolerances of single coordinates: a motion of micrometres is followed as exactly as one of metres.

use lagrange_core::prelude::*;
use lagrange_tests::{agree, certified};

/// Two oscillators that do not know of each other, one of them far faster.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = soft/2 * x^2 + hard/2 * y^2,
    start(displaced: x = wide, y = tall),
)]
struct Oscillators {
    mass: f64,
    soft: f64,
    hard: f64,
    wide: f64,
    tall: f64,
}

const ADAPTIVE: [Method; 6] = [
    Method::Auto,
    Method::Taylor,
    Method::DormandPrince853,
    Method::DormandPrince54,
    Method::Verner98,
    Method::Radau5,
];

/// x moves by micrometres, at 1 rad/s; y rests.
const TINY: Oscillators = Oscillators {
    mass: 1.0,
    soft: 1.0,
    hard: 1.0,
    wide: 1e-6,
    tall: 0.0,
};

/// Error of x = a cos t after 10 s, in units of a.
fn error(simulation: &Simulation<Oscillators>) -> f64 {
    let run = simulation.run(TINY.at(Oscillators::DISPLACED), 0.0..10.0);
    let end = run.expect("runs").final_state().q(Oscillators::X);
    (end / TINY.wide - 10.0_f64.cos()).abs()
}

#[test]
fn a_small_motion_is_as_exact_as_its_own_tolerance_says() {
    for method in ADAPTIVE {
        let simulation = Simulation::new(&TINY).method(method).tolerance(1e-7);
        assert!(error(&simulation) > 1e-5, "{method}: nothing to show");
        let own = simulation.absolute_tolerance(Oscillators::X, 1e-13);
        let error = error(&own);
        assert!(error < 1e-5, "{method}: {error:e}");
    }
}

#[test]
fn an_error_that_is_asked_for_is_that_of_the_coordinate() {
    let simulation = Simulation::new(&TINY).error(1e-3);
    let own = simulation.absolute_tolerance(Oscillators::X, 1e-15);
    assert!(error(&own) < 1e-9, "{:e}", error(&own));
}

/// The fast coordinate may be off by half of its amplitude, and its steps are long then; the slow one keeps its digits.
#[test]
fn a_coordinate_of_no_interest_does_not_shorten_the_steps() {
    let scene = Oscillators {
        hard: 1e4,
        wide: 1.0,
        tall: 1e-4,
        ..TINY
    };
    let start = scene.at(Oscillators::DISPLACED);
    for method in [Method::DormandPrince853, Method::DormandPrince54] {
        let simulation = Simulation::new(&scene).method(method).tolerance(1e-10);
        let all = simulation.run(start.clone(), 0.0..10.0).expect("runs");
        let own = simulation.absolute_tolerance(Oscillators::Y, 1e-2);
        let own = own.run(start.clone(), 0.0..10.0).expect("runs");
        assert!(own.work().steps * 3 < all.work().steps * 2, "{method}");
        let x = own.final_state().q(Oscillators::X);
        agree(method.to_string(), x, 10.0_f64.cos(), 1e-8);
        certified("", &own);
    }
}

#[test]
fn a_tolerance_that_is_none_is_refused() {
    // Beyond the largest number where it is counted in relative tolerances, of 1e-9.
    let large = "below 1.8e299";
    let none = "positive and finite";
    for (told, expected) in [
        ("0", none),
        ("-1", none),
        ("NaN", none),
        ("inf", none),
        ("1e300", large),
    ] {
        let tolerance = told.parse().expect("a number");
        let simulation = Simulation::new(&TINY).absolute_tolerance(Oscillators::X, tolerance);
        let run = simulation.run(TINY.at(Oscillators::DISPLACED), 0.0..1.0);
        let error = run.expect_err("no tolerance").to_string();
        let expected = format!("t = 0: `x`: absolute tolerance = {told}; it must be {expected}");
        assert_eq!(error, expected);
    }
    let another = CoordinateId(2);
    let simulation = Simulation::new(&TINY).absolute_tolerance(another, 1e-9);
    let run = simulation.run(TINY.at(Oscillators::DISPLACED), 0.0..1.0);
    assert!(matches!(
        run.expect_err("no coordinate").error,
        Error::Argument { value: 2.0, .. }
    ));
}
