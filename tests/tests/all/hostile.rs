//! Hostile input: an answer or a typed error, never a panic, a NaN, or no end.

use lagrange_core::prelude::*;
use lagrange_tests::agree;

/// A bob on a spring beside a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential(weight: mass * gravity * y),
    potential(spring: stiffness/2 * (x^2 + y^2)),
    contact(floor: y >= -1, restitution = bounce),
    friction(grip on floor: slip = der(x), static = mu),
)]
struct Bob {
    mass: f64,
    gravity: f64,
    stiffness: f64,
    bounce: f64,
    mu: f64,
}

fn bob() -> Bob {
    Bob {
        mass: 1.0,
        gravity: 9.81,
        stiffness: 3.0,
        bounce: 0.5,
        mu: 0.3,
    }
}

fn start() -> State<f64> {
    State::new(vec![0.5, 0.5], vec![0.3, -0.4])
}

/// Every number of a run is finite.
fn finite(trajectory: &Trajectory) {
    let last = trajectory.final_state();
    assert!(last.q.iter().chain(&last.v).all(|x| x.is_finite()));
    let mut sampler = trajectory.sampler();
    for t in trajectory.step_times() {
        let now = sampler.at(t).expect("evaluates");
        assert!(
            now.forces
                .iter()
                .chain(&now.acceleration)
                .all(|x| x.is_finite())
        );
    }
}

#[test]
fn parameters_that_are_not_numbers_are_named() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        type Set = fn(&mut Bob, f64);
        let set: [(Set, &str); 3] = [
            (|b, x| b.mass = x, "mass"),
            (|b, x| b.stiffness = x, "stiffness"),
            (|b, x| b.mu = x, "mu"),
        ];
        for (set, name) in set {
            let mut bob = bob();
            set(&mut bob, bad);
            let error = Simulation::new(&bob)
                .run(start(), 0.0..1.0)
                .expect_err("refused")
                .error;
            assert!(
                matches!(error, Error::Argument { what, .. } if what == name),
                "{error}"
            );
        }
    }
}

#[test]
fn parameters_of_any_size_run_or_say_why_not() {
    for size in [
        1e-300, 1e-100, 1e-30, 1e-8, 1e8, 1e30, 1e100, 1e300, 0.0, -1.0,
    ] {
        let scenes = [
            Bob {
                mass: size,
                ..bob()
            },
            Bob {
                stiffness: size,
                ..bob()
            },
            Bob {
                gravity: size,
                ..bob()
            },
            Bob { mu: size, ..bob() },
            Bob {
                bounce: size,
                ..bob()
            },
        ];
        for scene in scenes {
            let run = Simulation::new(&scene)
                .max_steps(2000)
                .max_events(2000)
                .run(start(), 0.0..1.0);
            match run {
                Ok(trajectory) => finite(&trajectory),
                Err(failure) => finite(&failure.trajectory),
            }
        }
    }
}

#[test]
fn the_unit_of_mass_does_not_matter() {
    let reference = Simulation::new(&bob())
        .tolerance(1e-12)
        .run(start(), 0.0..2.0)
        .expect("runs");
    for unit in [1e-8, 1e8] {
        let scene = Bob {
            mass: unit,
            stiffness: 3.0 * unit,
            ..bob()
        };
        let trajectory = Simulation::new(&scene)
            .tolerance(1e-12)
            .run(start(), 0.0..2.0)
            .expect("runs");
        assert_eq!(trajectory.events().len(), reference.events().len());
        for (a, b) in trajectory
            .final_state()
            .q
            .iter()
            .zip(&reference.final_state().q)
        {
            agree("position", *a, *b, 1e-11);
        }
    }
}

#[test]
fn spans_and_tolerances_out_of_bounds_are_refused() {
    let bob = bob();
    let simulation = Simulation::new(&bob);
    for span in [1.0..0.0, f64::NAN..1.0, 0.0..f64::NAN, 0.0..f64::INFINITY] {
        let error = simulation.run(start(), span).expect_err("refused").error;
        assert!(matches!(error, Error::Argument { .. }), "{error}");
    }
    for tolerance in [0.0, -1e-9, 1e-30, 1.0, f64::NAN, f64::INFINITY] {
        let run = Simulation::new(&bob)
            .tolerance(tolerance)
            .run(start(), 0.0..1.0);
        let error = run.expect_err("refused").error;
        assert!(
            matches!(
                error,
                Error::Argument {
                    what: "tolerance",
                    ..
                }
            ),
            "{error}"
        );
    }
    let nothing = simulation.run(start(), 2.0..2.0).expect("runs");
    assert_eq!(nothing.final_state(), &start());
    for method in [
        Method::RungeKutta4 { step: 0.0 },
        Method::Gauss6 { step: f64::NAN },
        Method::RungeKutta4 { step: -1.0 },
    ] {
        let run = Simulation::new(&bob)
            .method(method)
            .max_steps(1000)
            .run(start(), 0.0..1.0);
        assert!(run.is_err(), "{method}");
    }
}

#[test]
fn starts_that_make_no_sense_are_refused() {
    let bob = bob();
    let simulation = Simulation::new(&bob);
    for (q, v) in [
        (vec![f64::NAN, 0.0], vec![0.0; 2]),
        (vec![0.0; 2], vec![0.0, f64::INFINITY]),
        (vec![0.0; 3], vec![0.0; 2]),
        (vec![0.0; 2], vec![]),
        (vec![0.0, -2.0], vec![0.0; 2]),
    ] {
        let error = simulation
            .run(State::new(q, v), 0.0..1.0)
            .expect_err("refused")
            .error;
        assert!(
            matches!(
                error,
                Error::Domain { .. }
                    | Error::Dimension { .. }
                    | Error::Start { .. }
                    | Error::Penetrates { .. }
            ),
            "{error}"
        );
    }
}

#[test]
fn a_late_beginning_is_as_good_as_time_resolves() {
    let bob = bob();
    let early = Simulation::new(&bob).run(start(), 0.0..2.0).expect("runs");
    let late = Simulation::new(&bob)
        .run(start(), 1e9..1e9 + 2.0)
        .expect("runs");
    assert_eq!(early.events().len(), late.events().len());
    for (a, b) in late.final_state().q.iter().zip(&early.final_state().q) {
        // A second near 1e9 s is resolved to 1.2e-7.
        agree("position", *a, *b, 1e-5);
    }
    finite(&late);
}
