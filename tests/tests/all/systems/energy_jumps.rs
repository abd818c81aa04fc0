//! Energies that jump where no branch says so: the equations of motion hold on both sides, and say nothing of what happens between.

use super::{PI, state};
use lagrange_core::certificate::Subject;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, methods_at};

/// A motor of constant torque, declared as a potential of the angle between −π and π, turns a weight on an arm.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass * (der(x)^2 + der(y)^2) / 2,
    potential = -torque * atan2(y, x),
    constraint(arm: sqrt(x^2 + y^2) == length),
)]
struct Motor {
    mass: f64,
    length: f64,
    torque: f64,
}

/// The same torque as a force on the angle, which no cut belongs to.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass * (der(x)^2 + der(y)^2) / 2,
    force(motor: (-torque * y / length^2, torque * x / length^2) at (x, y)),
    constraint(arm: sqrt(x^2 + y^2) == length),
)]
struct Driven {
    mass: f64,
    length: f64,
    torque: f64,
}

/// A ball meets a step of height 2·step, which would slow it down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass * der(x)^2 / 2,
    potential = step * (x - edge) / sqrt((x - edge)^2),
)]
struct Step {
    mass: f64,
    step: f64,
    edge: f64,
}

/// A cart whose mass is another one beyond an edge.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = (mass + more * atan(1 / (x - edge))) * der(x)^2 / 2,
)]
struct Loaded {
    mass: f64,
    more: f64,
    edge: f64,
}

/// A bead on a rubber band to a pin beside its wire: steep near the pin, and without a jump.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass * der(x)^2 / 2,
    potential = pull * sqrt((x - edge)^2 + beside^2),
)]
struct Band {
    mass: f64,
    pull: f64,
    edge: f64,
    beside: f64,
}

/// The only check that a run falls short of, and when it does.
fn failed(what: &str, run: &Trajectory) -> (Subject, f64) {
    let certificate = run.verify(3).expect("a recorded run");
    let mut failed = certificate.checks.iter().filter(|check| !check.holds());
    let first = failed
        .next()
        .unwrap_or_else(|| panic!("{what}: {certificate}"));
    assert!(failed.next().is_none(), "{what}: {certificate}");
    (first.subject, first.time)
}

#[test]
fn a_torque_that_is_declared_as_a_potential_jumps_at_the_cut_of_its_angle() {
    let (mass, length, torque) = (0.8, 1.3, 0.7);
    let (motor, driven) = (
        Motor {
            mass,
            length,
            torque,
        },
        Driven {
            mass,
            length,
            torque,
        },
    );
    // φ¨ = M/(m l²) from φ = 0.2 with the rate 2.
    let (angle, rate, acceleration) = (0.2_f64, 2.0, torque / (mass * length * length));
    let start = || {
        let (s, c) = angle.sin_cos();
        let v = [-s, c].map(|along| length * rate * along);
        state(&[length * c, length * s], &v)
    };
    let reaches =
        |turned: f64| ((rate * rate + 2.0 * acceleration * turned).sqrt() - rate) / acceleration;
    let cut = reaches(PI - angle);
    for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-10]) {
        let what = format!("{method:?} {tolerance:e}");
        let run = |until: f64| {
            let simulation = Simulation::new(&motor).method(method).tolerance(tolerance);
            simulation.run(start(), 0.0..until).expect("a run")
        };
        certified(format!("{what} before the cut"), &run(0.99 * cut));
        let passed = run(1.01 * cut);
        let (subject, time) = failed(&what, &passed);
        assert_eq!(subject, Subject::Jumps, "{what}");
        assert!(time > 0.9 * cut, "{what}: {time} instead of {cut}");
        // The force is the right one all the same.
        let simulation = Simulation::new(&driven).method(method).tolerance(tolerance);
        let right = simulation.run(start(), 0.0..1.01 * cut).expect("a run");
        certified(&what, &right);
        agree(
            &what,
            passed.final_state().q[0],
            right.final_state().q[0],
            1e3 * tolerance,
        );
    }
}

#[test]
fn what_passes_a_step_of_its_potential_as_if_it_were_not_there_is_not_certified() {
    for (edge, speed) in [(0.37, 1.9), (-2.25, 0.6), (81.5, 7.0)] {
        let stepped = Step {
            mass: 1.2,
            step: 0.3,
            edge,
        };
        let loaded = Loaded {
            mass: 2.0,
            more: 0.4,
            edge,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-4, 1e-9]) {
            let what = format!("{method:?} {tolerance:e} edge {edge}");
            let start = state(&[edge - 0.8], &[speed]);
            let until = 0.0..2.0 / speed;
            let simulation = Simulation::new(&stepped)
                .method(method)
                .tolerance(tolerance);
            // Some methods refuse it.
            if let Ok(run) = simulation.run(start.clone(), until.clone()) {
                assert_eq!(failed(&what, &run).0, Subject::Jumps, "{what}");
            }
            let simulation = Simulation::new(&loaded).method(method).tolerance(tolerance);
            if let Ok(run) = simulation.run(start, until) {
                let certificate = run.verify(0).expect("a recorded run");
                assert!(!certificate.holds(), "{what}: {certificate}");
            }
        }
    }
}

#[test]
fn what_is_steep_without_a_jump_is_certified() {
    for beside in [1e-6, 1e-3, 0.4] {
        let band = Band {
            mass: 0.6,
            pull: 3.0,
            edge: 0.45,
            beside,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-4, 1e-9]) {
            let what = format!("{method:?} {tolerance:e} {beside:e} beside");
            let simulation = Simulation::new(&band).method(method).tolerance(tolerance);
            let run = simulation.run(state(&[-0.7], &[0.9]), 0.0..1.5);
            certified(&what, &run.expect("a run"));
        }
    }
}
