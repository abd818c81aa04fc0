//! What goes wrong is a typed error with numbers, and nothing is lost.

use lagrange_core::error::Level;
use lagrange_core::prelude::*;
use lagrange_problems::scenes::{MassOnShell, RollingSphere};
use lagrange_tests::agree;

fn shell() -> MassOnShell {
    MassOnShell::default()
}

fn fails(start: State<f64>, span: core::ops::Range<f64>) -> Error {
    Simulation::new(&shell())
        .run(start, span)
        .expect_err("must fail")
        .error
}

#[test]
fn a_start_inside_the_shell_is_refused_with_its_depth() {
    let error = fails(
        State {
            q: vec![0.9, 0.1],
            v: vec![0.0; 2],
        },
        0.0..1.0,
    );
    let Error::Start {
        item,
        level,
        residual,
        ..
    } = error
    else {
        panic!("{error}")
    };
    assert_eq!((item, level), ("shell", Level::Position));
    agree("depth", residual, -0.1, 1e-12);
}

#[test]
fn a_start_that_does_not_roll_is_refused_or_projected() {
    let scene = RollingSphere::default();
    let start = State {
        q: vec![1.2, 0.3, 0.0],
        v: vec![0.0, 1.0, 0.0],
    };
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

#[test]
fn arguments_are_checked() {
    let good = || State {
        q: vec![1.0, 0.1],
        v: vec![0.0; 2],
    };
    assert!(matches!(
        fails(
            State {
                q: vec![1.0],
                v: vec![0.0]
            },
            0.0..1.0
        ),
        Error::Dimension {
            expected: 2,
            found: 1
        }
    ));
    assert!(matches!(
        fails(
            State {
                q: vec![1.0, f64::NAN],
                v: vec![0.0; 2]
            },
            0.0..1.0
        ),
        Error::Argument { .. }
    ));
    assert!(matches!(
        fails(good(), 1.0..0.0),
        Error::Argument {
            what: "last time",
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
    assert!(failure.trajectory.sampler().at(last).expect("inside").q[1] > 0.01);
    assert!(matches!(
        failure.trajectory.sampler().at(last + 1.0),
        Err(Error::OutsideTrajectory { .. })
    ));
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
