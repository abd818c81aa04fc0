//! Estimates of errors against true errors, and errors that were asked for.

use lagrange_core::prelude::*;
use lagrange_core::trajectory::Summary;
use lagrange_tests::agree;
use lagrange_tests::exactness::{Estimated, Exact};
use lagrange_tests::families::contacts::{Chain, Rod};
use lagrange_tests::fuzz;

/// A ball on a floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y: "m"),
    kinetic   = mass * der(y)^2 / 2,
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    start(held: y = height),
)]
struct Ball {
    mass: f64,
    gravity: f64,
    bounce: f64,
    height: f64,
}

/// A body on a spring: x = cos t.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = x^2 / 2,
    mark(middle: x),
    start(pulled: x = 1),
)]
struct Spring {}

#[test]
fn random_runs_are_as_exact_as_they_say() {
    let (mut right, mut wrong) = (0, Vec::new());
    for number in 0..150 {
        let (run, found) = fuzz::ask::<Exact>(number);
        match found.estimate {
            Estimated::Known(told, error) if (0.3..=10.0).contains(&(told / error)) => right += 1,
            Estimated::Known(told, error) => wrong.push(format!("{run}: {told:e} not {error:e}")),
            Estimated::Unresolved | Estimated::Refused => {}
        }
        if let Estimated::Known(asked, error) = found.error {
            assert!(error <= asked, "{run}: {error:e} instead of {asked:e}");
        }
    }
    assert!(
        right > 80 && 20 * wrong.len() <= right,
        "{right} right, {wrong:#?}"
    );
}

#[test]
fn an_error_that_is_asked_for_holds_against_the_closed_form() {
    for method in [
        "taylor",
        "dop853",
        "dopri5",
        "verner98",
        "radau5",
        "rk4:0.1",
        "gauss6:0.1",
    ] {
        let method: Method = method.parse().expect("a method");
        for error in [1e-5, 1e-9] {
            let scene = Spring {};
            let simulation = Simulation::new(&scene).method(method).error(error);
            let run = simulation
                .run(scene.at(Spring::PULLED), 0.0..20.0)
                .expect("runs");
            let (q, v) = (&run.final_state().q, &run.final_state().v);
            let (sin, cos) = 20.0_f64.sin_cos();
            assert!(
                (q[0] - cos).abs() <= error && (v[0] + sin).abs() <= error,
                "{method}"
            );
            for (k, event) in run.events().iter().enumerate() {
                let exact = core::f64::consts::PI * (k as f64 + 0.5);
                assert!(
                    (event.time - exact).abs() <= error * exact.max(1.0),
                    "{method}"
                );
            }
            assert_eq!(run.events().len(), 6);
            let estimate = run.estimate().expect("was asked for");
            assert!(estimate.difference.error() <= error);
            assert_eq!(estimate.difference.events.len(), 6);
        }
    }
}

/// Bodies on springs, x = cos rate t, z = 2 cos rate t and y = -1.5 cos rate t, are in the middle at one instant, which a clock tells too.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, z, y),
    kinetic = (der(x)^2 + der(z)^2 + der(y)^2) / 2,
    potential = rate^2 / 2 * (x^2 + z^2 + y^2),
    contact(left: x >= 0, restitution = 1),
    contact(right: z >= 0, restitution = 1),
    mark(clock: t - quarter),
    mark(middle: y),
    start(pulled: x = 1, z = 2, y = -1.5),
    emit = data,
)]
struct Pair {
    rate: f64,
    quarter: f64,
}

#[test]
fn what_happens_at_one_instant_may_be_told_in_any_order() {
    for rate in [0.7, 1.1, 1.9] {
        let quarter = core::f64::consts::FRAC_PI_2 / rate;
        let scene = Pair { rate, quarter };
        for method in ["auto", "dop853", "verner98", "radau5", "rk4:0.01"] {
            let method: Method = method.parse().expect("a method");
            let simulation = Simulation::new(&scene).method(method);
            let run = |simulation: Simulation<Pair>| {
                simulation.run(scene.at(Pair::PULLED), 0.0..2.5 * quarter)
            };
            let within = run(simulation.clone().error(1e-8))
                .unwrap_or_else(|failure| panic!("{rate} {method}: {failure}"));
            let estimated = run(simulation.tolerance(1e-7).estimate(true)).expect("runs");
            for (run, error) in [(within, 1e-8), (estimated, 1e-5)] {
                let difference = &run.estimate().expect("was asked for").difference;
                assert_eq!(difference.parting, None, "{rate} {method}");
                assert!(
                    difference.error() <= error,
                    "{rate} {method}: {}",
                    difference.error()
                );
                assert_eq!(difference.events.len(), run.events().len());
                assert_eq!(run.events().len(), 4, "{rate} {method}");
                for event in run.events() {
                    agree("instant", event.time, quarter, error);
                }
            }
        }
    }
}

#[test]
fn what_only_one_run_has_or_at_another_instant_parts_them() {
    use Subject::{Contact, Mark};
    let scene = Pair {
        rate: 1.0,
        quarter: 9.0,
    };
    let run = Simulation::new(&scene).run(scene.at(Pair::PULLED), 0.0..0.1);
    let run = run.expect("runs");
    let summary = |events: &[(Subject, f64)]| {
        let kind = |subject| match subject {
            Mark(_) => EventKind::Mark,
            _ => EventKind::Impact,
        };
        let events = events.iter().map(|&(s, time)| (s, kind(s), time));
        Summary {
            events: events.collect(),
            ..Summary::of(&run)
        }
    };
    let told = |events: &[Subject; 3], times: [f64; 3]| {
        let events = events.iter().copied().zip(times);
        summary(&events.collect::<Vec<_>>())
    };
    let (clock, left, right) = (Mark(0), Contact(0), Contact(1));
    let here = told(&[left, right, left], [1.0, 1.0 + 1e-9, 2.0]);
    let marked = told(&[clock, left, clock], [1.0, 1.0 + 1e-9, 2.0]);
    // The order of impacts at one instant, and that of marks and impacts.
    for (here, other, exact) in [
        (
            &here,
            told(&[right, left, left], [1.0, 1.0 + 3e-9, 2.0]),
            [3e-9, 1e-9, 0.0],
        ),
        (
            &marked,
            told(&[left, clock, clock], [0.9, 1.2, 2.0]),
            [0.2, 0.1 + 1e-9, 0.0],
        ),
    ] {
        let difference = here.compare(&other);
        assert_eq!(difference.parting, None);
        for (found, exact) in difference.events.iter().zip(exact) {
            agree("difference", *found, exact, 1e-15);
        }
    }
    // Impacts at other instants, and what the other run has not, or has twice.
    for (here, other, time) in [
        (&here, told(&[right, left, left], [0.9, 1.2, 2.0]), 1.0),
        (&here, summary(&[(right, 1.0), (left, 2.0)]), 1.0),
        (&here, summary(&[(right, 1.0), (left, 1.0)]), 2.0),
        (&here, told(&[right, right, left], [1.0, 1.0, 1.0]), 2.0),
        (&marked, summary(&[(left, 1.0), (clock, 2.0)]), 1.0),
        (&marked, summary(&[(left, 1.0), (clock, 1.0)]), 2.0),
    ] {
        let parting = here.compare(&other).parting.expect("they part");
        agree("parting", parting.time, time, 1e-15);
    }
}

#[test]
fn an_estimate_is_the_error() {
    let scene = Spring {};
    for method in [
        "taylor",
        "dop853",
        "dopri5",
        "verner98",
        "radau5",
        "rk4:0.01",
        "gauss6:0.1",
    ] {
        let simulation = Simulation::new(&scene).method(method.parse().expect("a method"));
        let simulation = simulation.tolerance(1e-7).estimate(true);
        let run = simulation
            .run(scene.at(Spring::PULLED), 0.0..20.0)
            .expect("runs");
        let told = &run.estimate().expect("was asked for").difference;
        let (sin, cos) = 20.0_f64.sin_cos();
        let (q, v) = (&run.final_state().q, &run.final_state().v);
        let error = (q[0] - cos).abs().max((v[0] + sin).abs());
        let ratio = told.state_error / error;
        assert!((0.5..2.0).contains(&ratio), "{method}: {ratio}");
    }
}

/// A wheel at rest that a torque begins to turn: φ = t − sin t.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(phi),
    kinetic = der(phi)^2 / 2,
    force(torque: phi = sin(t)),
    start(rests),
)]
struct Wheel {}

/// Steps that grow as fast as a method lets them are the same at all tolerances; those of the run that the first is compared with are not.
#[test]
fn an_estimate_of_a_short_run_is_none_of_equal_steps() {
    let scene = Wheel {};
    for method in ["dop853", "dopri5", "verner98", "radau5"] {
        let simulation = Simulation::new(&scene).method(method.parse().expect("a method"));
        for tolerance in [1e-3, 1e-4, 1e-6] {
            let simulation = simulation.clone().tolerance(tolerance).estimate(true);
            for until in [1.3, 2.0, 2.6, 3.3, 3.996] {
                let run = simulation.run(scene.at(Wheel::RESTS), 0.0..until);
                let run = run.expect("runs");
                let (q, v) = (&run.final_state().q, &run.final_state().v);
                let (sin, cos) = f64::sin_cos(until);
                let off = |x: f64, exact: f64| (x - exact).abs() / exact.max(1.0);
                let error = off(q[0], until - sin).max(off(v[0], 1.0 - cos));
                let told = run.estimate().expect("was asked for").difference.error();
                let ratio = told / error;
                let case = format!("{method} at {tolerance} until {until}: {told:e}, {error:e}");
                assert!((0.5..2.0).contains(&ratio), "{case}");
            }
        }
    }
}

/// Whether an estimate is asked for besides, before or after, changes nothing of the error that a run is to be within.
#[test]
fn an_error_asked_for_stays_so() {
    let scene = Spring {};
    let plain = Simulation::new(&scene);
    for simulation in [
        plain.clone().error(1e-12).estimate(true),
        plain.clone().error(1e-12).estimate(false),
        plain.clone().estimate(true).error(1e-12),
        plain.clone().estimate(false).error(1e-12),
    ] {
        let run = simulation.run(scene.at(Spring::PULLED), 0.0..7.0);
        let run = run.expect("runs");
        let (sin, cos) = 7.0_f64.sin_cos();
        agree("x", run.final_state().q[0], cos, 1e-12);
        agree("ẋ", run.final_state().v[0], -sin, 1e-12);
        let told = &run.estimate().expect("there is one").difference;
        assert!(told.error() <= 1e-12 && run.tolerance() < 1e-12);
    }
}

#[test]
fn bounces_that_accumulate_are_one_instant() {
    let (mass, gravity, height) = (1.0, 9.81, 1.0);
    for bounce in [0.3, 0.8, 0.95] {
        let ball = Ball {
            mass,
            gravity,
            bounce,
            height,
        };
        let simulation = Simulation::new(&ball).error(1e-11);
        let run = simulation
            .run(ball.at(Ball::HELD), 0.0..40.0)
            .expect("runs");
        let rest = (2.0 * height / gravity).sqrt() * (1.0 + bounce) / (1.0 - bounce);
        let events = run.events();
        let end = events
            .iter()
            .find(|e| matches!(e.kind, EventKind::Accumulates { .. }));
        let end = end.expect("it comes to rest").time;
        assert!(
            (end - rest).abs() <= 1e-11 * rest,
            "{end} instead of {rest}"
        );
    }
}

/// Drawn by fuzzing: the impacts of both ends shrink in no steady ratio.
#[test]
fn the_end_of_impacts_of_two_contacts_is_as_certain_as_the_tolerance() {
    let rod = Rod {
        mass: 1.4446785851216672,
        inertia: 0.1486972346011478,
        half: 0.7568671519467056,
        bounce: 0.31810121579451317,
        mu: 0.2705045456966014,
    };
    let start = State::new(
        vec![0.0, 1.5121702896212803, 0.007209059984908173],
        vec![0.9513935142789203, 1.535229717053836, 0.38942938452651443],
    );
    let run = |tolerance: f64| {
        let simulation = Simulation::new(&rod).tolerance(tolerance);
        Summary::of(&simulation.run(start.clone(), 0.0..2.0).expect("runs"))
    };
    let truth = run(1e-15);
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
        let found = run(tolerance);
        let difference = found.compare(&truth);
        assert_eq!(difference.parting, None);
        assert_eq!(difference.events.len(), found.events.len());
        assert!(
            difference.error() <= 5.0 * tolerance,
            "{tolerance}: {}",
            difference.error()
        );
    }
}

/// A box of half width `wide` and half height `high` falls on corners that rebound.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, theta),
    kinetic = der(y)^2 / 2 + (wide^2 + high^2) / 6 * der(theta)^2,
    potential = 9.81 * y,
    contact(left: y - wide * sin(theta) - high * cos(theta) >= 0, restitution = bounce),
    contact(right: y + wide * sin(theta) - high * cos(theta) >= 0, restitution = bounce),
    start(tilted: y = drop + high * cos(tilt) + wide * sin(tilt), theta = tilt),
)]
struct Crate {
    wide: f64,
    high: f64,
    bounce: f64,
    tilt: f64,
    drop: f64,
}

/// One corner bounces infinitely often while the other rests, and then the other way round, infinitely often.
#[test]
fn corners_that_come_to_rest_in_turn_are_as_certain_as_their_last_turns_are_short() {
    for (wide, high, bounce, tilt, drop) in [
        (0.5, 1.0, 0.1, 0.05, 1.0),
        (0.4, 0.9, 0.2, 0.08, 0.3),
        (0.5, 0.7, 0.3, 0.03, 0.6),
        (0.7, 0.6, 0.15, 0.1, 0.8),
        (0.6, 0.5, 0.25, 0.05, 0.4),
    ] {
        let box_ = Crate {
            wide,
            high,
            bounce,
            tilt,
            drop,
        };
        let run = |simulation: Simulation<Crate>| {
            let run = simulation.run(box_.at(Crate::TILTED), 0.0..20.0);
            run.unwrap_or_else(|failure| panic!("{box_:?}: {failure}"))
        };
        let truth = run(Simulation::new(&box_).tolerance(1e-14));
        let rest = |run: &Trajectory<f64>| run.events().last().expect("it rests").time;
        // In a hundred-millionth of a second the corners rise by no more than rounding: that is how well the last turns are known.
        for error in [1e-4, 1e-6, 1e-7] {
            let found = run(Simulation::new(&box_).error(error));
            agree("rest", rest(&found), rest(&truth), error);
            agree("height", found.final_state().q[0], high, error);
            let estimate = found.estimate().expect("estimated");
            assert_eq!(estimate.difference.parting, None);
            assert_eq!(estimate.difference.events.len(), found.events().len());
        }
    }
}

#[test]
fn chaos_says_what_can_be_had() {
    let chain = Chain {
        mass: [1.0, 0.7, 0.4],
        length: [1.0, 0.8, 0.6],
        depth: 100.0,
        bounce: 0.0,
        mu: 0.0,
    };
    let start = State::new(vec![2.0, 2.5, 1.5], vec![0.0; 3]);
    let failure = Simulation::new(&chain)
        .error(1e-9)
        .run(start.clone(), 0.0..60.0)
        .expect_err("rounding grows by more than that");
    let Error::Inexact {
        asked, possible, ..
    } = failure.error
    else {
        panic!("{failure}");
    };
    assert!(asked == 1e-9 && possible > 1e-9);
    // What can be had is not told as less than it is, which might be what was asked for.
    let near = Error::Inexact {
        asked: 1e-10,
        possible: 1.21e-10,
        reason: "rounding".to_owned(),
    };
    assert_eq!(
        near.to_string(),
        "an error of 1e-10 cannot be had, one of 1.3e-10 can: rounding"
    );
    // There is the motion, and how far off it is.
    assert_eq!(failure.trajectory.last_time(), 60.0);
    assert!(failure.trajectory.estimate().is_some());
    // Earlier it can be had.
    let run = Simulation::new(&chain).error(1e-9).run(start, 0.0..4.0);
    assert!(run.is_ok_and(|run| run.estimate().is_some()));
}

/// Nothing grows in an oscillation: what can be had by fixed steps ends where more steps round more, and what is told can be had.
#[test]
fn fixed_steps_say_what_can_be_had() {
    let scene = Spring {};
    for step in [0.5, 0.2] {
        let method = Method::Gauss6 { step };
        let within = |error| {
            let simulation = Simulation::new(&scene).method(method).error(error);
            simulation.run(scene.at(Spring::PULLED), 0.0..6.0)
        };
        let failure = within(1e-15).expect_err("less than rounding");
        let said = failure.to_string();
        assert!(said.contains("however short the steps are"), "{said}");
        let (_, rest) = said.split_once("one of ").expect("what can be had");
        let (possible, _) = rest.split_once(" can").expect("what can be had");
        let possible: f64 = possible.parse().expect("a number");
        let run = within(possible).unwrap_or_else(|failure| panic!("{method}: {said}; {failure}"));
        let error = (run.final_state().q(Spring::X) - 6.0_f64.cos()).abs();
        assert!(error <= possible, "{method}: {error:e}");
    }
}

#[test]
fn runners_and_ensembles_keep_the_error_too() {
    let scene = Spring {};
    let simulation = Simulation::new(&scene).error(1e-12);
    let mut runner = simulation.runner();
    let start = scene.at(Spring::PULLED);
    let mut ends = Vec::new();
    for _ in 0..2 {
        let run = runner.run(&start, 0.0..3.0).expect("runs");
        ends.push(run.final_state().clone());
    }
    simulation.ensemble().run(
        3,
        0.0..3.0,
        |_, _| Some(start.clone()),
        |_, outcome, run| {
            outcome.expect("runs");
            ends.push(run.final_state().clone());
        },
    );
    assert_eq!(ends.len(), 5);
    assert!(ends.iter().all(|end| *end == ends[0]));
    assert!((ends[0].q[0] - 3.0_f64.cos()).abs() < 1e-12);
}

#[test]
fn an_error_out_of_reach_of_numbers_is_refused() {
    let scene = Spring {};
    for error in [0.0, -1.0, f64::NAN, 1e-16, 0.2] {
        let run = Simulation::new(&scene)
            .error(error)
            .run(scene.at(Spring::PULLED), 0.0..1.0);
        let failure = run.expect_err("no error to ask for");
        assert!(
            matches!(failure.error, Error::Argument { what: "error", .. }),
            "{failure}"
        );
    }
}
