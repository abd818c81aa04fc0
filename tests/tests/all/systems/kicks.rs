//! Energies that jump: what would kick velocities is refused, and a potential that changes with time alone does work.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, closure, methods_at, run_by};

/// A pendulum on a pivot that a cam lifts and drops: its speed jumps from −0.6 to 0.6 at each bottom.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(phi),
    define(lift = rise * abs(sin(rate * t)), bob = [length * sin(phi), lift - length * cos(phi)]),
    kinetic = mass/2 * dot(der(bob), der(bob)),
    potential = mass * gravity * bob[1],
)]
struct Lifted {
    mass: f64,
    length: f64,
    gravity: f64,
    rise: f64,
    rate: f64,
}

/// Light, as Newton thought of it: it is faster below a surface.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = if(y <= depth, -step, 0),
)]
struct Ray {
    mass: f64,
    depth: f64,
    step: f64,
}

/// A skater who draws in the arms at an instant.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(turn),
    kinetic = if(t <= instant, wide, narrow)/2 * der(turn)^2,
)]
struct Skater {
    instant: f64,
    wide: f64,
    narrow: f64,
}

/// Meissner's oscillator, whose stiffness changes at once and back.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = if(sin(rate * t) >= 0, stiff, soft)/2 * x^2,
)]
struct Switched {
    mass: f64,
    stiff: f64,
    soft: f64,
    rate: f64,
}

/// A run that is refused: when, which momentum jumps, what jumps before and after, and where the first coordinate is then.
type Kick = (f64, Option<&'static str>, [f64; 2], f64);

fn kick<S: System<Scalar = f64>>(scene: &S, start: State<f64>) -> Vec<Kick> {
    let all = methods_at(METHODS, [1e-4, 1e-9]).map(|(method, tolerance)| {
        let simulation = Simulation::new(scene).method(method).tolerance(tolerance);
        let failure = simulation.run(start.clone(), 0.0..9.0).expect_err("a kick");
        let Error::Kick {
            time,
            momentum,
            before,
            after,
            ..
        } = failure.error
        else {
            panic!("{method} at {tolerance}: {failure}")
        };
        assert_eq!(failure.trajectory.last_time(), time);
        let place = failure.trajectory.final_state().q[0];
        (time, momentum, [before, after], place)
    });
    all.collect()
}

#[test]
fn momenta_that_jump_are_refused() {
    let lifted = Lifted {
        mass: 0.8,
        length: 0.5,
        gravity: 9.81,
        rise: 0.2,
        rate: 3.0,
    };
    for (time, momentum, [before, after], phi) in kick(&lifted, state(&[1.0], &[0.0])) {
        agree("bottom of the cam", time, core::f64::consts::PI / 3.0, 1e-6);
        assert_eq!(momentum, Some("phi"));
        // p = m (l² φ̇ + l ẏ sin φ), and ẏ jumps by twice 0.6.
        let jump = 0.8 * 0.5 * 1.2 * phi.sin();
        agree("jump", after - before, jump, 1e-12);
    }
    let skater = Skater {
        instant: 1.5,
        wide: 3.0,
        narrow: 1.0,
    };
    for (time, momentum, values, _) in kick(&skater, state(&[0.0], &[2.0])) {
        agree("instant", time, 1.5, 1e-6);
        assert_eq!(momentum, Some("turn"));
        assert_eq!(values, [6.0, 2.0]);
    }
}

#[test]
fn the_step_of_a_potential_is_refused() {
    let ray = Ray {
        mass: 2.0,
        depth: -1.5,
        step: 0.7,
    };
    for (time, momentum, [before, after], _) in kick(&ray, state(&[0.0; 2], &[1.0, -2.0])) {
        agree("surface", time, 0.75, 1e-9);
        assert_eq!(momentum, None);
        agree("above", before, 5.0, 1e-9);
        agree("below", after, 5.7, 1e-9);
    }
}

#[test]
fn a_stiffness_that_changes_at_once_does_work() {
    let switched = Switched {
        mass: 0.5,
        stiff: 8.0,
        soft: 2.0,
        rate: 2.0,
    };
    let until = 7.0;
    // Swing by swing, each an oscillation of its own.
    let (mut x, mut v, mut t) = (1.0_f64, 0.3_f64, 0.0);
    let mut changes = 0;
    while t < until {
        let stiffness = match changes % 2 {
            0 => switched.stiff,
            _ => switched.soft,
        };
        changes += 1;
        let next = f64::min(
            f64::from(changes) * core::f64::consts::PI / switched.rate,
            until,
        );
        let w = (stiffness / switched.mass).sqrt();
        let (s, c) = (w * (next - t)).sin_cos();
        (x, v, t) = (x * c + v / w * s, v * c - w * x * s, next);
    }
    for method in METHODS {
        let run = run_by(&switched, (method, 1e-10), state(&[1.0], &[0.3]), until);
        agree(method, run.final_state().q[0], x, 1e-7);
        agree(method, run.final_state().v[0], v, 1e-7);
        assert!(closure(&run) < 1e-8, "{method}: {}", closure(&run));
    }
}

/// No force acts up to the kick, and the energies at the end are those before it.
#[test]
fn the_ledger_up_to_a_kick_closes() {
    let book = |failure: Failure| {
        let ledger = failure.trajectory.ledger().expect("a ledger");
        agree("closure", ledger.closure, 0.0, 1e-12);
        [ledger.end.kinetic, ledger.end.potential]
    };
    let ray = Ray {
        mass: 3.0,
        depth: -0.4,
        step: 2.0,
    };
    let refused = Simulation::new(&ray).run(state(&[0.0; 2], &[0.5, -1.0]), 0.0..2.0);
    let [kinetic, potential] = book(refused.expect_err("a kick"));
    agree("kinetic energy", kinetic, 1.875, 1e-12);
    assert_eq!(potential, 0.0);
    let skater = Skater {
        instant: 0.8,
        wide: 5.0,
        narrow: 2.0,
    };
    let refused = Simulation::new(&skater).run(state(&[0.0], &[3.0]), 0.0..2.0);
    let [kinetic, _] = book(refused.expect_err("a kick"));
    agree("kinetic energy", kinetic, 22.5, 1e-12);
}
