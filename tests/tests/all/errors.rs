//! What goes wrong is a typed error with numbers, and nothing is lost.

use lagrange_core::error::{Level, NotFinite};
use lagrange_core::prelude::*;
use lagrange_problems::scenes::hard::BouncingBall;
use lagrange_problems::scenes::{Kepler, MassOnShell, MassOnWheel, RollingSphere};
use lagrange_tests::{METHODS, TOLERANCES, agree};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn shell() -> MassOnShell {
    MassOnShell::default()
}

fn fails(start: State<f64>, span: core::ops::Range<f64>) -> Error {
    Simulation::new(&shell())
        .run(start, span)
        .expect_err("must fail")
        .error
}

/// The trajectory of a run that was refused for its start has nothing to be read, which is an error as well.
#[test]
fn starts_of_another_dimension_can_be_read_from_no_trajectory() {
    for (q, v) in [(1, 0), (1, 1), (5, 5), (2, 3)] {
        let failure = Simulation::new(&shell())
            .run(State::new(vec![1.0; q], vec![0.0; v]), 0.0..1.0)
            .expect_err("two coordinates");
        let trajectory = failure.trajectory;
        let dimension = |error: Error| matches!(error, Error::Dimension { expected: 2, .. });
        assert!(dimension(failure.error));
        let sampled = trajectory.sampler().at(trajectory.last_time());
        assert!(sampled.is_err_and(dimension));
        assert!(trajectory.ledger().is_err_and(dimension));
        assert!(trajectory.verify(1).is_err_and(dimension));
    }
}

/// A run within an error that means nothing is refused at its start, as every other: its trajectory is no motion of before.
#[test]
fn an_error_without_meaning_leaves_the_start() {
    let scene = shell();
    let start = State::new(vec![1.0, 0.1], vec![0.0; 2]);
    let simulation = Simulation::new(&scene).error(0.0);
    let mut runner = simulation.runner();
    for time in [0.0, 3.0] {
        let refused = runner.run(&start, time..time + 1.0).map(|_| ());
        assert!(matches!(
            refused,
            Err(Error::Argument { what: "error", .. })
        ));
        let trajectory = runner.trajectory();
        assert_eq!(trajectory.first_state(), &start);
        assert_eq!(trajectory.final_state(), &start);
        assert_eq!(
            (trajectory.first_time(), trajectory.last_time()),
            (time, time)
        );
    }
}

/// A rod without length: r² = 0 lets nothing hold the mass, which falls.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity * y,
    constraint(rod: x^2 + y^2 == length^2),
)]
struct Pinned {
    length: f64,
    gravity: f64,
}

#[test]
fn what_follows_an_error_of_the_start_is_no_motion() {
    let pinned = Pinned {
        length: 0.0,
        gravity: 9.81,
    };
    let start = State::new(vec![0.0; 2], vec![0.0; 2]);
    let failure = Simulation::new(&pinned).run(&start, 0.0..1.0);
    let failure = failure.expect_err("nothing holds it");
    assert!(matches!(failure.error, Error::Singular { time: 0.0, .. }));
    assert_eq!(failure.trajectory.last_time(), 0.0);
    assert_eq!(failure.trajectory.final_state(), &start);
    assert_eq!(failure.trajectory.work().steps, 0);
}

/// A gas whose pressure grows like 1/x³ keeps a piston from the bottom.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    potential(gas: pressure/(2*x^2)),
    potential(gravity: weight * x),
    contact(bottom: x >= 0),
)]
struct Piston {
    pressure: f64,
    weight: f64,
}

/// From rest x² = 1 + t²; at the bottom forces are infinite, and without the gas the piston rests there.
#[test]
fn a_contact_at_a_pole_is_never_reached_or_told() {
    let run = |x: f64, weight, effects: Effects| {
        let piston = Piston {
            pressure: 1.0,
            weight,
        };
        let simulation = Simulation::new(&piston).effects(effects);
        let run = simulation.run(State::new(vec![x], vec![0.0]), 0.0..3.0);
        run.map(|run| run.final_state().q[0])
    };
    let end = run(1.0, 0.0, Effects::all()).expect("no contact");
    assert!((end - 10.0_f64.sqrt()).abs() < 1e-8, "{end}");
    let pressed = run(0.0, 0.0, Effects::all()).expect_err("no forces");
    let told = pressed.error;
    assert!(matches!(told, Error::NotFinite { .. }), "{told}");
    assert!(pressed.trajectory.work().steps < 10);
    let empty = Effects::all().without(Piston::GAS);
    assert!(run(0.0, 1.0, empty).is_ok_and(|x| x == 0.0));
}

/// A bead in a well whose potential has a value on one side only: of a logarithm below zero there are derivatives still.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential(hill: 2*x),
    potential(well: ln(x - edge)),
    potential(pole: small/(x - far)),
    potential(arc: small*acos(x/wide)),
    potential(root: small*sqrt(x - low)),
)]
struct Well {
    edge: f64,
    far: f64,
    wide: f64,
    low: f64,
    small: f64,
}

#[test]
fn the_item_that_has_no_value_at_the_start_is_named() {
    let good = Well {
        edge: 0.0,
        far: 9.0,
        wide: 9.0,
        low: 0.0,
        small: 1e-3,
    };
    let run = |well: Well| {
        let run = Simulation::new(&well).run(State::new(vec![0.5], vec![0.0]), 0.0..0.1);
        run.map_err(|failure| failure.error)
    };
    assert!(run(good.clone()).is_ok());
    let [mut edge, mut far, mut wide, mut low] = [(); 4].map(|()| good.clone());
    (edge.edge, far.far, wide.wide, low.low) = (1.0, 0.5, 0.25, 0.75);
    for (well, name, why) in [
        (edge, "well", "ln(-0.5)"),
        (far, "pole", "a division by 0"),
        (wide, "arc", "acos(2)"),
        (low, "root", "(-0.25)^0.5"),
    ] {
        let error = run(well).expect_err("no value");
        let Error::NotFinite { what, item, .. } = &error else {
            panic!("{error}");
        };
        assert_eq!(*item, Some(name), "{error}");
        assert!(what.contains(why), "{error}");
    }
}

/// A ball with friction that meets the floor after √(2/g).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    force(sway: x = mass * cos(t)),
    contact(floor: y >= 0, restitution = 1/2),
    friction(grip on floor: slip = der(x), static = 1/3),
)]
struct Heavy {
    mass: f64,
    gravity: f64,
}

#[test]
fn what_is_beyond_all_numbers_is_called_so() {
    let told = |mass, time: f64| {
        let heavy = Heavy {
            mass,
            gravity: 9.81,
        };
        let start = State::new(vec![0.0, 1.0], vec![0.0; 2]);
        let run = Simulation::new(&heavy).run(start, time..time + 1.0);
        run.map(|_| ()).map_err(|failure| failure.error)
    };
    assert_eq!(told(1.0, 0.0), Ok(()));
    let impulse = told(1e308, 0.0).expect_err("m v overflows");
    assert!(
        matches!(
            impulse,
            Error::NotFinite {
                cause: NotFinite::Range,
                ..
            }
        ),
        "{impulse}"
    );
    // Doubles near 10¹⁵ are an eighth apart.
    let late = told(1.0, 1e15).expect_err("no time between");
    assert!(
        late.to_string().contains("count them from a later instant"),
        "{late}"
    );
    // Those of a clock that counts from 1970 are a quarter of a microsecond apart.
    let fell = |time: f64, step: f64| Error::StepTooSmall {
        time,
        step,
        mode: String::new(),
    };
    let late = fell(1.7e9, 6e-8).to_string();
    assert!(late.contains("count them from a later instant"), "{late}");
    let singular = fell(1.0, 1e-16).to_string();
    assert!(singular.contains("tolerance is too tight"), "{singular}");
}

#[test]
fn items_of_another_system_cannot_be_left_out() {
    let items: [Item; 3] = [
        ForceId(9).into(),
        ContactId(9).into(),
        ConstraintId(9).into(),
    ];
    for item in items {
        let scene = shell();
        let failure = Simulation::new(&scene)
            .effects(Effects::all().without(item))
            .run(State::new(vec![1.0, 0.1], vec![0.0; 2]), 0.0..1.0)
            .expect_err("no such item");
        assert!(
            matches!(failure.error, Error::Argument { value: 9.0, .. }),
            "{failure}"
        );
    }
}

#[test]
fn an_attitude_is_no_effect() {
    let body = Free { inertia: [1.0; 3] };
    let d = Free::DESCRIPTION;
    assert!(Item::all(d).all(|item| item.name(d) != "body"));
    let failure = Simulation::new(&body)
        .effects(Effects::all().without(Free::BODY))
        .run(body.at(Free::SPUN), 0.0..1.0)
        .expect_err("an orientation of no quaternion");
    assert!(
        failure.to_string().contains("this one is an attitude"),
        "{failure}"
    );
}

#[test]
fn what_a_state_is_to_be_consistent_with_is_checked() {
    let scene = shell();
    let given = State::new(vec![1.0, 0.1], vec![0.0; 2]);
    let with = |fixed, time| Simulation::new(&scene).consistent(time, &given, &fixed);
    let fixed = FixedComponents::default;
    let [r, theta] = [CoordinateId(0), CoordinateId(1)];
    assert!(with(fixed().q(theta, 0.3), 0.0).is_ok());
    for number in [f64::NAN, f64::INFINITY] {
        let refused = with(fixed().q(theta, number), 0.0);
        assert!(matches!(refused, Err(Error::Domain { item: "theta", .. })));
        let refused = with(fixed().v(r, number), 0.0);
        assert!(matches!(refused, Err(Error::Domain { item: "r", .. })));
        let refused = with(fixed(), number);
        assert!(matches!(refused, Err(Error::Argument { .. })));
    }
    let refused = with(fixed().q(CoordinateId(7), 1.0), 0.0);
    assert!(matches!(refused, Err(Error::Argument { value: 7.0, .. })));
}

#[test]
fn a_start_inside_the_shell_is_refused_with_its_depth() {
    let error = fails(State::new(vec![0.9, 0.1], vec![0.0; 2]), 0.0..1.0);
    let Error::Penetrates { item, gap, .. } = error else {
        panic!("{error}")
    };
    assert_eq!(item, "shell");
    agree("depth", gap, -0.1, 1e-12);
}

#[test]
fn a_start_that_does_not_roll_is_refused_or_projected() {
    let scene = RollingSphere::default();
    let start = State::new(vec![1.2, 0.3, 0.0], vec![0.0, 1.0, 0.0]);
    let failure = Simulation::new(&scene)
        .run(start.clone(), 0.0..1.0)
        .expect_err("does not roll");
    assert!(
        matches!(
            failure.error,
            Error::Start {
                item: "rolling",
                level: Level::Velocity,
                ..
            }
        ),
        "{failure}"
    );
    let trajectory = Simulation::new(&scene)
        .project_start(true)
        .run(start, 0.0..0.01)
        .expect("projected");
    let v = &trajectory.first_state().v;
    agree("rolling", 1.2 * v[1] - 0.2 * v[2], 0.0, 1e-14);
    // Least change in the mass metric: Δv = M⁻¹ aᵀ μ.
    let (row, inverse) = ([1.2, -0.2], [1.0 / 1.44, 1.0 / (0.4 * 0.04)]);
    let compliance: f64 = (0..2).map(|j| row[j] * row[j] * inverse[j]).sum();
    agree(
        "θ̇",
        v[1],
        1.0 - inverse[0] * row[0] * 1.2 / compliance,
        1e-12,
    );
}

/// A rod so small that what is above the floor is within what a start may be off.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, theta),
    kinetic = mass / 2 * der(y)^2 + mass * length^2 / 24 * der(theta)^2,
    potential = mass * gravity * y,
    contact(end: y - length/2 * sin(theta) >= 0),
)]
struct Rod {
    mass: f64,
    length: f64,
    gravity: f64,
}

#[test]
fn a_start_is_not_moved_to_another_one_unasked() {
    let rod = |length| Rod {
        mass: 1.0,
        length,
        gravity: 9.81,
    };
    let lies = |length: f64| State::new(vec![length, 0.6], vec![0.0; 2]);
    let failure = Simulation::new(&rod(1e-12)).run(lies(1e-12), 0.0..1e-6);
    let error = failure.expect_err("turns the rod").error;
    let Error::Start {
        item,
        level,
        residual,
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert_eq!((item, level), ("end", Level::Position));
    agree("gap", residual, 1e-12 * (1.0 - 0.5 * 0.6_f64.sin()), 1e-24);
    // A larger one falls.
    let motion = Simulation::new(&rod(1e-3)).run(lies(1e-3), 0.0..1e-3);
    let motion = motion.expect("falls");
    agree("θ", motion.final_state().q[1], 0.6, 1e-15);
}

#[test]
fn arguments_are_checked() {
    let good = || State::new(vec![1.0, 0.1], vec![0.0; 2]);
    assert!(matches!(
        fails(State::new(vec![1.0], vec![0.0]), 0.0..1.0),
        Error::Dimension {
            expected: 2,
            found: 1
        }
    ));
    assert!(matches!(
        fails(State::new(vec![1.0, f64::NAN], vec![0.0; 2]), 0.0..1.0),
        Error::Domain {
            item: "theta",
            what: "position at the start",
            ..
        }
    ));
    assert!(matches!(
        fails(good(), 1.0..0.0),
        Error::Argument {
            what: "last time",
            ..
        }
    ));
    assert!(matches!(
        fails(good(), -f64::MAX..f64::MAX),
        Error::Argument {
            what: "last time less the first",
            ..
        }
    ));
    assert!(matches!(
        fails(good(), 0.0..f64::INFINITY),
        Error::Argument {
            what: "last time",
            ..
        }
    ));
    let scene = MassOnShell {
        gravity: f64::NAN,
        ..shell()
    };
    let error = Simulation::new(&scene)
        .run(good(), 0.0..1.0)
        .expect_err("NaN parameter")
        .error;
    assert!(matches!(
        error,
        Error::Argument {
            what: "gravity",
            ..
        }
    ));
    for tolerance in [0.0, -1.0, f64::NAN, 1.0] {
        let error = Simulation::new(&shell())
            .tolerance(tolerance)
            .run(good(), 0.0..1.0)
            .expect_err("tolerance")
            .error;
        assert!(matches!(
            error,
            Error::Argument {
                what: "tolerance",
                ..
            }
        ));
    }
}

#[test]
fn a_share_of_the_steps_is_one() {
    let run = Simulation::new(&shell()).run(State::new(vec![1.0, 0.1], vec![0.0; 2]), 0.0..0.1);
    let run = run.expect("a run");
    for share in [f64::NAN, -0.1, 1.5] {
        let refused = run.verify_share(1, share).expect_err("no share");
        assert!(matches!(
            refused,
            Error::Argument {
                what: "share of the steps",
                ..
            }
        ));
    }
    for share in [0.0, 1.0] {
        assert!(run.verify_share(1, share).expect("a certificate").holds());
    }
}

/// Two bodies take about a step per radian: 1e20 s are out of reach long before the last step that is allowed.
#[test]
fn a_run_whose_end_is_out_of_reach_is_told_so() {
    let scene = Kepler::default();
    let start = scene.at(<Kepler>::PERICENTRE);
    for method in ["taylor", "dop853", "dopri5"] {
        let failure = Simulation::new(&scene)
            .method(method.parse().expect("a method"))
            .record(false)
            .max_steps(20_000)
            .run(&start, 0.0..1e20)
            .expect_err("no run takes as many steps");
        let Error::OutOfReach {
            time,
            end: 1e20,
            steps,
            limit: 20_000,
        } = failure.error
        else {
            panic!("{method}: {}", failure.error);
        };
        let made = failure.trajectory.work().steps as f64;
        assert!(made < 100.0, "{method}: {made}");
        let rate = steps * time / 1e20;
        assert!((rate / made - 1.0).abs() < 1e-6, "{method}: {rate}");
    }
}

/// A needle that is driven apart from where it rests, θ ~ e^(rate t), beside a weak bar magnet: it turns ever faster.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = der(theta)^2 / 2,
    potential = -weak * cos(theta) - rate^2 * theta^2 / 2,
    start(beside: theta = 1),
)]
struct Needle {
    weak: f64,
    rate: f64,
}

/// Its steps are a part of a turn, and a turn takes e^(−rate t): in ln 2/rate their number doubles. What comes to rest has ever longer steps.
#[test]
fn a_motion_that_becomes_faster_and_faster_is_out_of_reach_early() {
    let scene = Needle {
        weak: 2.0,
        rate: 2.5,
    };
    for method in ["taylor", "dop853", "dopri5"] {
        let run = |until: f64| {
            Simulation::new(&scene)
                .method(method.parse().expect("a method"))
                .record(false)
                .max_steps(1_000_000)
                .run(scene.at(Needle::BESIDE), 0.0..until)
        };
        let failure = run(500.0).expect_err("no run takes as many steps");
        let Error::OutOfReach { time, steps, .. } = failure.error else {
            panic!("{method}: {}", failure.error);
        };
        // A thousand times as many as it may take.
        assert!(steps > 1e9, "{method}: {steps}");
        let made = failure.trajectory.work().steps as f64;
        assert!(made < 10_000.0, "{method}: {made}");
        // It could go on for a while: e^(rate/2) = 3.5 times as many steps at most take it half a second farther, and half as many again at least.
        let run = run(time + 0.5).unwrap_or_else(|failure| panic!("{method}: {failure}"));
        let more = run.work().steps as f64 / made;
        assert!((1.5..3.5).contains(&more), "{method}: {more}");
    }
}

/// A mass that is pushed for a moment.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(push: x = if(t <= moment, 1, 0)),
    start(rests),
)]
struct Pushed {
    moment: f64,
}

#[test]
fn a_run_that_begins_with_a_short_step_is_within_reach() {
    for moment in [1e-6, 3e-9] {
        let scene = Pushed { moment };
        for method in ["auto", "dop853", "verner98"] {
            let run = Simulation::new(&scene)
                .method(method.parse().expect("a method"))
                .max_steps(1000)
                .run(scene.at(Pushed::RESTS), 0.0..500.0);
            let run = run.unwrap_or_else(|failure| panic!("{method}: {failure}"));
            let x = moment * (500.0 - 0.5 * moment);
            agree(method, run.final_state().q[0], x, 1e-12);
        }
    }
}

#[test]
fn a_limit_keeps_the_trajectory_so_far() {
    let scene = shell();
    let start = scene.at(<MassOnShell>::REST);
    let failure = Simulation::new(&scene)
        .max_steps(5)
        .run(start, 0.0..10.0)
        .expect_err("five steps are too few");
    assert!(matches!(failure.error, Error::Limit { limit: 5, .. }));
    assert_eq!(failure.trajectory.work().steps, 5);
    let last = failure.trajectory.last_time();
    assert!(
        failure
            .trajectory
            .sampler()
            .at(last)
            .expect("inside")
            .state
            .q[1]
            > 0.01
    );
    assert!(matches!(
        failure.trajectory.sampler().at(last + 1.0),
        Err(Error::OutsideTrajectory { .. })
    ));
}

/// The chapter of the book on errors has a row for each of them, and for no other.
#[test]
fn the_book_lists_every_error() {
    let read = |path: &str| {
        let core = Path::new(env!("CARGO_MANIFEST_DIR")).join("../lagrange-core/src");
        fs::read_to_string(core.join(path)).expect("text")
    };
    let source = read("error/mod.rs");
    let variants = source.split("pub enum Error {").nth(1).expect("the errors");
    let variants = variants.split("\n}").next().expect("their end").lines();
    let variants = variants.filter_map(|line| line.strip_prefix("    "));
    let variants: BTreeSet<&str> = variants
        .filter(|line| line.starts_with(|c: char| c.is_ascii_uppercase()))
        .map(|line| line.trim_end_matches([' ', '{', ',']))
        .collect();
    let book = read("book/errors.md");
    let rows = book.lines().filter_map(|line| line.strip_prefix("| `"));
    let listed: BTreeSet<&str> = rows
        .filter_map(|row| row.split("` |").next())
        .flat_map(|names| names.split("`, `"))
        .collect();
    assert!(variants.len() > 20, "{variants:?}");
    assert_eq!(listed, variants);
}

/// What `unwrap` prints of it is a sentence and a summary, however long the run was.
#[test]
fn a_failure_is_shown_in_short() {
    let scene = BouncingBall::default();
    let failure = Simulation::new(&scene)
        .tolerance(1e-12)
        .max_events(50)
        .run(lagrange_tests::first_start(&scene), 0.0..1e3)
        .expect_err("bounces more often");
    let shown = format!("{failure:?}");
    let trajectory = &failure.trajectory;
    for part in [
        failure.error.to_string(),
        format!("last_time: {:?}", trajectory.last_time()),
        format!("steps: {}", trajectory.work().steps),
        format!("events: {}", trajectory.events().len()),
        "is hit".to_owned(),
    ] {
        assert!(shown.contains(&part), "{part} in {shown}");
    }
    assert!(shown.len() < 400, "{shown}");
    // A run that could not begin has done nothing.
    let failure = Simulation::new(&scene).run(State::new(vec![1.0], vec![]), 0.0..1.0);
    let shown = format!("{:?}", failure.expect_err("no velocity"));
    assert!(shown.contains("steps: 0, events: 0, .."), "{shown}");
}

#[test]
fn an_empty_span_is_the_start() {
    let scene = shell();
    let trajectory = Simulation::new(&scene)
        .run(scene.at(<MassOnShell>::REST), 0.0..0.0)
        .expect("nothing to do");
    assert_eq!(trajectory.final_state(), trajectory.first_state());
    assert_eq!(
        trajectory
            .sampler()
            .at(0.0)
            .expect("the start")
            .mode
            .contacts,
        [true]
    );
}

/// The error of a run from the first start, which must come before any step.
#[track_caller]
fn refused<S: Derived<Scalar = f64>>(scene: &S) -> Error {
    let failure = Simulation::new(scene)
        .run(lagrange_tests::first_start(scene), 0.0..1.0)
        .map(|trajectory| lagrange_tests::words(&trajectory))
        .expect_err("must be refused");
    assert_eq!(failure.trajectory.work().steps, 0, "{failure}");
    failure.error
}

/// A ring that rolls and a bead above it; nothing is said about its fields.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, phi, r, theta),
    define(px = x + r * sin(theta), py = r * cos(theta)),
    kinetic = ring/2 * der(x)^2 + inertia/2 * der(phi)^2 + mass/2 * (der(px)^2 + der(py)^2),
    constraint(rolling: der(x) == der(phi)),
    start(above: r = 1, theta = 0.1),
)]
struct Ring {
    ring: f64,
    inertia: f64,
    mass: f64,
}

/// A free body, its attitude in four numbers.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    attitude(body: q),
    kinetic = sum(k in 0..3: inertia[k]/2 * body.body_rate[k]^2),
    start(spun: q[0] = 1, der(q[2]) = 1),
)]
struct Free {
    inertia: [f64; 3],
}

#[test]
fn numbers_outside_their_domain_are_refused_by_item_and_field() {
    let wheel = MassOnWheel::default;
    let wheels = [
        (
            MassOnWheel {
                mu_kinetic: 0.61,
                ..wheel()
            },
            "grip",
            "kinetic friction",
            0.61,
            "mu_kinetic",
        ),
        (
            MassOnWheel {
                mu_kinetic: -0.5,
                ..wheel()
            },
            "grip",
            "kinetic friction",
            -0.5,
            "mu_kinetic",
        ),
        (
            MassOnWheel {
                mu_static: -0.5,
                ..wheel()
            },
            "grip",
            "static friction",
            -0.5,
            "mu_static",
        ),
    ];
    let balls = [1.2, -0.1].map(|bounce| BouncingBall {
        bounce,
        ..BouncingBall::default()
    });
    let wheels =
        wheels.map(|(scene, item, what, value, field)| (refused(&scene), item, what, value, field));
    let rings =
        [(-1.0, 2.0, 3.0), (1.0, -5.0, 3.0), (0.2, 0.5, -1.0)].map(|(mass, inertia, ring)| Ring {
            mass,
            inertia,
            ring,
        });
    let [mass, inertia, ring] = rings.map(|ring| refused(&ring));
    let rings = [
        (mass, "r", "inertia", -1.0, "mass"),
        (inertia, "phi", "inertia", -5.0, "inertia"),
        // The ring and the mass on it: −1 + 0.2.
        (ring, "x", "inertia", -0.8, "ring"),
    ];
    let balls = balls.map(|ball| {
        (
            refused(&ball),
            "floor",
            "restitution",
            ball.bounce,
            "bounce",
        )
    });
    for (error, item, what, value, field) in wheels.into_iter().chain(rings).chain(balls) {
        let Error::Domain {
            item: found,
            what: number,
            value: is,
            ref fields,
            ..
        } = error
        else {
            panic!("{item}: {error}")
        };
        assert_eq!((found, number), (item, what), "{error}");
        agree(what, is, value, 1e-15);
        assert!(fields.iter().any(|(name, _)| *name == field), "{error}");
    }
}

#[test]
fn inertia_is_judged_where_the_constraints_leave_motion() {
    // The matrix of the quaternion is singular, and positive where its constraint lets it move.
    let body = |second| Free {
        inertia: [1.0, second, 3.0],
    };
    let run = Simulation::new(&body(2.0)).run(body(2.0).at(Free::SPUN), 0.0..0.1);
    assert!(run.is_ok());
    let error = refused(&body(-2.0));
    assert!(
        matches!(&error, Error::Domain { what: "inertia", fields, .. } if fields[..] == [("inertia[1]", -2.0)]),
        "{error}"
    );
}

/// A disc that a cone brakes: the steeper its flanks, the more their friction holds.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, turn),
    kinetic = (der(x)^2 + der(turn)^2)/2,
    potential = 5*x,
    contact(cone: x >= 0),
    friction(lining on cone: slip = der(turn), static = mu/sine, kinetic = 0.9*mu/sine),
    start(pressed: der(turn) = 1),
)]
struct Cone {
    mu: f64,
    sine: f64,
}

#[test]
fn a_coefficient_that_is_no_finite_number_is_refused_with_its_fields() {
    let cone = |sine| Cone { mu: 0.1, sine };
    let run = Simulation::new(&cone(0.5)).run(cone(0.5).at(Cone::PRESSED), 0.0..0.1);
    let slows = run.expect("a cone").final_state().v[1];
    agree("rate", slows, 1.0 - 0.9 * 0.1 / 0.5 * 5.0 * 0.1, 1e-12);
    let error = refused(&cone(0.0));
    assert!(
        matches!(&error, Error::Domain { item: "lining", value: f64::INFINITY, fields, .. } if fields.contains(&("sine", 0.0))),
        "{error}"
    );
}

/// A coefficient that is legal at the start and not where it acts later.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = 10*y,
    contact(floor: y >= 0, restitution = bounce + x),
    start(high: y = 1, der(x) = 1),
)]
struct Livelier {
    bounce: f64,
}

#[test]
fn a_coefficient_that_leaves_its_domain_is_named_where_it_does() {
    let scene = Livelier { bounce: 0.8 };
    let error = Simulation::new(&scene)
        .run(scene.at(Livelier::HIGH), 0.0..3.0)
        .expect_err("0.8 + √0.2 > 1")
        .error;
    let Error::Domain {
        time,
        item: "floor",
        what: "restitution",
        value,
        ..
    } = error
    else {
        panic!("{error}")
    };
    agree("time", time, 0.2_f64.sqrt(), 1e-9);
    agree("restitution", value, 0.8 + 0.2_f64.sqrt(), 1e-9);
}

#[test]
fn steps_that_lose_the_motion_are_named_as_such() {
    let scene = MassOnWheel::default();
    for (method, length) in [
        ("rk4:10", 10.0),
        ("gauss6:10", 10.0),
        ("rk4:1", 1.0),
        ("gauss6:1", 1.0),
        ("rk4:0.3", 0.3),
    ] {
        let error = Simulation::new(&scene)
            .method(method.parse().expect("a method"))
            .run(scene.at(<MassOnWheel>::REST), 0.0..20.0)
            .expect_err("far too long")
            .error;
        assert!(
            matches!(error, Error::StepTooLarge { step, .. } if step == length),
            "{method}: {error}"
        );
    }
}

/// Two disks on a shaft.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a: "rad", b: "rad"),
    kinetic   = sum(k in 0..2: density * radius[k]^4) * der(a)^2 / 4 + rotor/2 * der(b)^2,
    potential = spring/2 * (a - b)^2,
    start(turned: a = 1, der(b) = 1),
)]
struct Disks {
    density: f64,
    #[lagrange(domain = "positive")]
    radius: [f64; 2],
    #[lagrange(unit = "kg m^2", domain = "nonnegative")]
    rotor: f64,
    spring: f64,
}

#[test]
fn a_field_outside_its_domain_is_refused_by_name() {
    let disks = |inner: f64, rotor: f64| Disks {
        density: 1.0,
        radius: [1.0, inner],
        rotor,
        spring: 3.0,
    };
    let run = |scene: &Disks| {
        let run = Simulation::new(scene).run(scene.at(Disks::TURNED), 0.0..1.0);
        run.map(drop).map_err(|failure| failure.error)
    };
    assert_eq!(run(&disks(0.5, 2.0)), Ok(()));
    // Every power of it is even: the motion would be that of 0.5.
    for (scene, name, wrong) in [
        (disks(-0.5, 2.0), "radius[1]", -0.5),
        (disks(0.0, 2.0), "radius[1]", 0.0),
        (disks(0.5, -2.0), "rotor", -2.0),
    ] {
        let error = run(&scene).expect_err("outside its domain");
        let Error::Domain { item, value, .. } = error else {
            panic!("{error}");
        };
        assert_eq!((item, value), (name, wrong));
        let fixed = FixedComponents::default().q(Disks::A, 0.1);
        let moved = Simulation::new(&scene).consistent(0.0, scene.at(Disks::TURNED), &fixed);
        assert!(matches!(moved, Err(Error::Domain { .. })));
    }
    // Nothing turns then: it is legal, but cannot be solved.
    assert!(matches!(run(&disks(0.5, 0.0)), Err(Error::Singular { .. })));
    let error = run(&disks(-0.5, 2.0)).expect_err("outside its domain");
    assert_eq!(
        error.to_string(),
        "t = 0: `radius[1]`: value = -0.5; it must be positive"
    );
}

/// A puck on a wet table, with powers that begin at zero.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    potential = 10 * z,
    contact(table: z >= 0),
    friction(film on table: slip = (der(x), der(y)), static = 0, kinetic = norm([der(x), der(y)])^0.6),
    force(pull: x = 1 + strength * sqrt(y)),
    stop(far: x^0.3 >= 1),
)]
struct Wet {
    strength: f64,
}

/// What has no Taylor series where the run begins is named. Stops need none: this one is at a root of zero there, and ends the run where x = t² is 1.
#[test]
fn what_has_no_series_is_named() {
    let wet = Wet { strength: 1.0 };
    let run = |without: &[Item], y: f64| {
        let effects = without
            .iter()
            .fold(Effects::all(), |effects, item| effects.without(*item));
        let start = State::new(vec![0.0, y, 0.0], vec![0.0; 3]);
        Simulation::new(&wet).effects(effects).run(start, 0.0..2.0)
    };
    let named = |without: &[Item], y: f64, operation: &str| match run(without, y)
        .expect_err("no series")
        .error
    {
        Error::Singular { items, reason, .. } => {
            assert!(reason.contains(operation), "{reason}");
            items
        }
        error => panic!("{error}"),
    };
    let (film, far) = (Wet::FILM.into(), Wet::FAR.into());
    assert_eq!(named(&[far], 1.0, "power"), ["film"]);
    assert_eq!(named(&[film, far], 0.0, "square root"), ["x"]);
    let stopped = run(&[film], 1.0).expect("a run");
    assert!((stopped.last_time() - 1.0).abs() < 1e-9, "{stopped:?}");
}

/// A collar on a guide that runs down to the left at 3 in 4, pressed onto a plank that slides.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, s),
    kinetic = plank/2 * der(x)^2 + collar/2 * (rise^2 + run^2) * der(s)^2,
    force(press: s = -load),
    contact(face: rise * s >= 0),
    friction(rub on face: slip = der(x) - run * der(s), static = mu),
)]
struct Collar {
    plank: f64,
    collar: f64,
    load: f64,
    rise: f64,
    run: f64,
    mu: f64,
}

/// Where the friction angle is that of the guide, normal force and friction together do not move the collar: that is not for want of
/// inertia.
#[test]
fn a_collar_that_locks_itself_is_told() {
    let collar = Collar {
        plank: 2.0,
        collar: 0.5,
        load: 3.0,
        rise: 3.0,
        run: 4.0,
        mu: 0.75,
    };
    let start = State::new(vec![0.0; 2], vec![-1.0, 0.0]);
    let failure = Simulation::new(&collar)
        .run(start, 0.0..1.0)
        .expect_err("nothing carries the load");
    let text = failure.error.to_string();
    assert!(
        text.contains("locks itself") && text.contains("`face`"),
        "{text}"
    );
}

/// A ball between an anvil and a press that comes down on it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = mass/2 * der(y)^2,
    potential = mass * gravity * y,
    contact(anvil: y >= 0, restitution = e),
    contact(press: y <= height - speed * t, restitution = e),
)]
struct Press {
    mass: f64,
    gravity: f64,
    height: f64,
    speed: f64,
    e: f64,
}

/// There is no friction that could be the cause.
#[test]
fn a_press_that_meets_the_anvil_is_told_without_friction() {
    let press = Press {
        mass: 1.0,
        gravity: 9.81,
        height: 1.0,
        speed: 0.7,
        e: 0.4,
    };
    let start = State::new(vec![0.3], vec![0.0]);
    let failure = Simulation::new(&press)
        .run(start, 0.0..2.0)
        .expect_err("the press meets the anvil");
    let text = failure.error.to_string();
    let at = failure.trajectory.last_time();
    agree("where they meet", at, press.height / press.speed, 1e-6);
    assert!(
        text.contains("room between") && !text.contains("friction"),
        "{text}"
    );
}

/// A body on a spring.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = stiffness/2 * x^2 * exp(grow * x),
)]
struct Sprung {
    mass: f64,
    stiffness: f64,
    grow: f64,
}

/// So it is in the middle of a run; no step has been made here.
#[test]
fn what_overflows_at_a_start_is_told_as_such() {
    for (mass, stiffness, grow, expected) in [
        (1e-290, 1e30, 0.0, NotFinite::Range),
        (1.0, 1.0, 1e3, NotFinite::Exponential),
    ] {
        let scene = Sprung {
            mass,
            stiffness,
            grow,
        };
        let simulation = Simulation::new(&scene);
        let start = || State::new(vec![1.0], vec![0.0]);
        let failed = simulation.run(start(), 0.0..1.0).expect_err("overflows");
        let listed = simulation.feasible_modes(0.0, start());
        for error in [failed.error, listed.expect_err("overflows")] {
            let Error::NotFinite { cause, .. } = &error else {
                panic!("{error}")
            };
            assert_eq!(*cause, expected, "{error}");
        }
    }
}

/// A block is pulled across a plane by a force that grows, with friction that falls with the speed.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    friction(plane: slip = (der(x), der(y)), normal = load, static = 0.5, kinetic = 0.2 + 0.3 * exp(-norm(slip))),
    force(pull: (3 * t, 4 * t) at (x, y)),
)]
struct Dragged {
    load: f64,
}

/// The same, with what its error says to write, and along the line on which it moves.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, s),
    kinetic = (der(x)^2 + der(y)^2 + der(s)^2) / 2,
    friction(plane: slip = (der(x), der(y)), normal = 10, static = 0.5,
        kinetic = 0.2 + 0.3 * exp(-sqrt(dot(slip, slip) + slow^2))),
    friction(line: slip = der(s), normal = 10, static = 0.5, kinetic = 0.2 + 0.3 * exp(-abs(slip))),
    force(pull: (3 * t, 4 * t) at (x, y)),
    force(straight: 5 * t along der(s)),
)]
struct Smoothed {
    slow: f64,
}

#[test]
fn a_norm_of_a_slip_that_begins_is_told_what_to_write_in_its_place() {
    let failure = Simulation::new(&Dragged { load: 10.0 })
        .run(State::new(vec![0.0; 2], vec![0.0; 2]), 0.0..4.0)
        .expect_err("no series");
    assert!(
        failure.to_string().contains("sqrt(dot(slip, slip) + v0^2)"),
        "{failure}"
    );
    let run = Simulation::new(&Smoothed { slow: 1e-6 })
        .run(State::new(vec![0.0; 3], vec![0.0; 3]), 0.0..4.0)
        .unwrap_or_else(|failure| panic!("{failure}"));
    let end = run.final_state();
    assert!(end.q(Smoothed::S) > 1.0);
    agree("x", end.q(Smoothed::X), 0.6 * end.q(Smoothed::S), 1e-5);
    agree("y", end.q(Smoothed::Y), 0.8 * end.q(Smoothed::S), 1e-5);
}

/// A relay pushes a body towards its goal, wherever it is.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(relay: if(x + der(x) >= goal, -push, push) along der(x)),
)]
struct Relay {
    goal: f64,
    push: f64,
}

/// On its way, and where it begins at its goal.
#[test]
fn a_relay_that_has_no_mode_is_told_no_causes_of_contacts() {
    for start in [0.0, 0.5] {
        let failure = Simulation::new(&Relay {
            goal: 0.5,
            push: 2.0,
        })
        .run(State::new(vec![start], vec![0.0]), 0.0..4.0)
        .expect_err("no mode");
        assert!(matches!(failure.error, Error::NoMode { .. }), "{failure}");
        let told = failure.to_string();
        assert!(told.contains("a controller that switches"), "{told}");
        assert!(
            !told.contains("contact") && !told.contains("Painlevé"),
            "{told}"
        );
    }
}

/// A piece of chalk that is pushed over a rough board, tip first, and a sponge that lies on a bench.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(u, w, x, y, lean),
    kinetic = (der(u)^2 + der(w)^2 + der(x)^2 + der(y)^2 + der(lean)^2/12)/2,
    potential = 9.81*(w + y),
    contact(bench: w >= 0),
    friction(hold on bench: slip = der(u), static = 0.5),
    contact(board: y >= sin(lean)/2),
    friction(scratch on board: slip = der(x) + sin(lean)/2 * der(lean), static = mu),
    start(pushed: y = sin(1)/2, lean = 1, der(x) = -1, der(u) = slides),
)]
struct Chalk {
    mu: f64,
    slides: f64,
}

/// That Painlevé's chalk has no mode is not the fault of what lies or slides beside it.
#[test]
fn what_has_no_mode_is_named_and_not_what_is_elsewhere() {
    for slides in [0.0, 0.5] {
        let chalk = Chalk { mu: 2.0, slides };
        let failure = Simulation::new(&chalk)
            .run(chalk.at(Chalk::PUSHED), 0.0..0.1)
            .expect_err("no mode");
        let Error::NoMode { item, .. } = failure.error else {
            panic!("{failure}")
        };
        assert!(["board", "scratch"].contains(&item), "{slides}: {item}");
    }
}

/// A body that is driven along a rail, with a load that exists up to a place only.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    force(load: x = if(form <= 0, sqrt(reach - x), ln(reach - x))),
    constraint(drive: der(x) == speed),
    start(driven: der(x) = speed),
)]
struct Driven {
    reach: f64,
    speed: f64,
    form: f64,
}

/// No motion feels that it is missed, but the force of the drive does.
#[test]
fn a_force_of_a_constraint_that_is_no_number_ends_the_run() {
    for form in [0.0, 1.0] {
        let scene = Driven {
            reach: 0.87,
            speed: 1.5,
            form,
        };
        for method in METHODS {
            let failure = Simulation::new(&scene)
                .method(method)
                .run(scene.at(Driven::DRIVEN), 0.0..1.5)
                .expect_err("no force");
            let ends = failure.trajectory.last_time();
            let place = scene.reach / scene.speed;
            let what = format!("{form} by {method}: {ends} of {place}, {failure}");
            assert!(ends <= place + 1e-12 && ends > 0.3 * place, "{what}");
        }
    }
}

/// A hoop that carries a heavy point, and that a constraint keeps from slipping while it touches the ground.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, turn),
    define(point = [x + sin(turn), y + cos(turn)]),
    kinetic = hoop/2*(der(x)^2 + der(y)^2 + der(turn)^2) + dot(der(point), der(point))/2,
    potential = 9.81*(hoop*y + point[1]),
    contact(ground: y >= 1),
    constraint(roll while ground: der(x) == der(turn)),
)]
struct Hoop {
    hoop: f64,
}

/// Where the ground would have to pull, its constraint holds on: neither with it nor without it does the motion go on.
#[test]
fn a_constraint_that_holds_where_its_contact_would_have_to_pull_is_told() {
    let failure = Simulation::new(&Hoop { hoop: 0.02 })
        .run(
            State::new(vec![0.0, 1.0, 0.0], vec![0.01, 0.0, 0.01]),
            0.0..20.0,
        )
        .expect_err("no mode");
    let Error::NoMode { item, held, .. } = failure.error else {
        panic!("{failure}")
    };
    assert_eq!((item, held), ("ground", Some("roll")));
    let told = failure.to_string();
    assert!(told.contains("let a friction on it hold instead"), "{told}");
}

/// A crank that is driven, with friction in its pin, swings its end into a table.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(turn, x, y),
    kinetic = der(turn)^2/2 + mass/2 * (der(x)^2 + der(y)^2),
    constraint(drive: turn == rate * t),
    constraint(aside: x == arm * cos(turn)),
    constraint(up: y == arm * sin(turn)),
    friction(pin on (aside, up): slip = pin_radius * der(turn), static = mu, kinetic = mu),
    contact(table: y <= height, restitution = 0),
    start(level: x = arm, der(turn) = rate, der(y) = arm * rate),
)]
struct DrivenCrank {
    mass: f64,
    rate: f64,
    arm: f64,
    pin_radius: f64,
    mu: f64,
    height: f64,
}

/// Friction is no cause: without it there is no impact either.
#[test]
fn what_is_driven_into_a_contact_is_not_blamed_on_friction() {
    let scene = DrivenCrank {
        mass: 3.0,
        rate: 1.6,
        arm: 0.5,
        pin_radius: 0.02,
        mu: 0.3,
        height: 0.3,
    };
    let failure = Simulation::new(&scene)
        .run(scene.at(DrivenCrank::LEVEL), 0.0..2.0)
        .expect_err("no impact");
    let Error::NoImpact { time, friction, .. } = failure.error else {
        panic!("{failure}")
    };
    agree("time", time, 0.6_f64.asin() / scene.rate, 1e-10);
    assert!(!friction);
    let told = failure.to_string();
    assert!(told.contains("something may be driven into it"), "{told}");
}

/// A point held at the origin by a condition that is a square.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = weight * y,
    constraint(pin: x^2 + y^2 == 0),
    start(held),
)]
struct Squared {
    weight: f64,
}

/// A disc whose axle is held in a bearing by a product that is largest where it fits, and a bead on two lines that cross.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    attitude(disc: q),
    kinetic = dot(disc.body_rate, disc.body_rate) / 2 + (der(x)^2 + der(y)^2) / 2,
    potential = weight * y,
    force(twist: 1 along disc.space_rate[0]),
    constraint(axle: dot(disc.axes[2], [0, 3/5, 4/5]) == 1),
    constraint(lines: x * y == 0),
    start(fits: disc.turn = (-acos(4/5), 0, 0), disc.body_rate = (0, 0, 3), x = 1),
    start(crosses: disc.turn = (-acos(4/5), 0, 0), der(x) = 1),
)]
struct Bearing {
    weight: f64,
}

#[test]
fn a_constraint_that_is_extremal_where_it_holds_is_named() {
    let named = |failure: &Failure, wanted: &str| {
        let Error::Singular { items, reason, .. } = &failure.error else {
            panic!("{failure}");
        };
        assert_eq!(items[..], [wanted], "{failure}");
        assert!(reason.contains("smallest or largest"), "{failure}");
    };
    let scene = Squared { weight: 9.81 };
    let run = Simulation::new(&scene).run(scene.at(Squared::HELD), 0.0..1.0);
    named(&run.expect_err("no force"), "pin");

    let scene = Bearing { weight: 9.81 };
    let run = Simulation::new(&scene).run(scene.at(Bearing::FITS), 0.0..1.0);
    named(&run.expect_err("no torque"), "axle");

    // A start that is far from the constraint says nothing about it.
    let start = State::new(vec![3.0, 1.0], vec![0.0; 2]);
    let failure = Simulation::new(&Squared { weight: 9.81 })
        .run(start, 0.0..1.0)
        .expect_err("off the constraint");
    assert!(
        !failure.to_string().contains("smallest or largest"),
        "{failure}"
    );

    // Without the bearing, two lines that cross are no extremum: there are both signs around.
    let simulation = Simulation::new(&scene).effects(Effects::all().without(Bearing::AXLE));
    let run = simulation.run(scene.at(Bearing::FITS), 0.0..1.0);
    assert_eq!(run.expect("along a line").final_state().q(Bearing::X), 1.0);
    let failure = simulation
        .run(scene.at(Bearing::CROSSES), 0.0..1.0)
        .expect_err("two lines");
    assert!(
        !failure.to_string().contains("smallest or largest"),
        "{failure}"
    );
}

/// A uniform rod slides forward on its tip.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, a),
    define(tip_x = x + half * cos(a), tip_y = y - half * sin(a)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass * half^2 / 6 * der(a)^2,
    potential = mass * gravity * y,
    contact(floor: tip_y >= 0),
    friction(rub on floor: slip = der(tip_x), static = mu),
    start(sliding: a = lean, y = half * sin(lean), der(a) = turn, der(y) = half * cos(lean) * turn,
        der(x) = speed + half * sin(lean) * turn),
)]
struct SlidingRod {
    mass: f64,
    half: f64,
    gravity: f64,
    mu: f64,
    lean: f64,
    speed: f64,
    turn: f64,
}

/// Where 1 + 3 cos a (cos a − μ sin a), which divides the normal force, falls to zero, no step arrives.
#[test]
fn a_force_that_grows_without_bound_names_its_contact() {
    for (mass, mu) in [(1.0, 1.617459609678009), (5.0, 1.617459609678009)] {
        let rod = SlidingRod {
            mass,
            half: 0.5,
            gravity: 9.81,
            mu,
            lean: 0.5942181785175038,
            speed: 4.576885209108196,
            turn: 2.742583605913481,
        };
        for tolerance in TOLERANCES {
            let simulation = Simulation::new(&rod).tolerance(tolerance);
            let failure = simulation
                .run(rod.at(SlidingRod::SLIDING), 0.0..1.0)
                .expect_err("jams");
            let Error::Unbounded { item, from, to, .. } = failure.error else {
                panic!("{tolerance:e}: {failure}")
            };
            assert_eq!(item, "floor");
            let a = failure.trajectory.final_state().q(SlidingRod::A);
            let divisor = |a: f64| 1.0 + 3.0 * a.cos() * (a.cos() - mu * a.sin());
            assert!(
                divisor(a).abs() < 1e-2 * divisor(rod.lean),
                "{}",
                divisor(a)
            );
            let begins = rod.gravity - rod.half * rod.lean.sin() * rod.turn.powi(2);
            agree("force", from, mass * begins / divisor(rod.lean), 1e-8);
            assert!(to > 10.0 * from, "{to}");
        }
    }
}

/// A block slides under a load that falls with its way, on ground that grows smoother, or against a brake whose limit does.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    friction(load: slip = der(x), normal = weight - lifts*x, static = mu),
    friction(ground: slip = der(x), normal = weight, static = mu - smoother*x),
    friction(brake: slip = der(x), limit = mu*(weight - looser*x)),
    start(go: der(x) = speed),
)]
struct Lightened {
    weight: f64,
    mu: f64,
    lifts: f64,
    smoother: f64,
    looser: f64,
    speed: f64,
}

#[test]
fn friction_does_not_push() {
    let block = Lightened {
        weight: 5.0,
        mu: 0.4,
        lifts: 0.0,
        smoother: 0.0,
        looser: 0.0,
        speed: 4.0,
    };
    for (item, what, scene) in [
        (
            "load",
            "normal force",
            Lightened {
                lifts: 12.5,
                ..block
            },
        ),
        (
            "ground",
            "kinetic friction",
            Lightened {
                smoother: 1.0,
                ..block
            },
        ),
        (
            "brake",
            "kinetic friction",
            Lightened {
                looser: 12.5,
                ..block
            },
        ),
    ] {
        for method in METHODS {
            let simulation = Simulation::new(&scene).method(method);
            let failure = simulation.run(scene.at(Lightened::GO), 0.0..3.0);
            let failure = failure.expect_err("it would push");
            let Error::Domain {
                item: found,
                what: number,
                ..
            } = failure.error
            else {
                panic!("{item}: {}", failure.error)
            };
            assert_eq!(found, item, "{method}");
            assert!(number == what || number == "static friction", "{number}");
            // All three are nothing where it is 0.4 m on.
            agree(
                method.to_string(),
                failure.trajectory.final_state().q[0],
                0.4,
                1e-5,
            );
        }
        let begins = Lightened {
            weight: -1.0,
            ..scene
        };
        let refused = Simulation::new(&begins).run(begins.at(Lightened::GO), 0.0..1.0);
        let refused = refused.expect_err("a load that pulls");
        assert!(matches!(refused.error, Error::Domain { .. }), "{refused}");
    }
}
