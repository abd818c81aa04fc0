//! Friction that fades with its slip is viscous: it neither sticks nor reverses where the slip has decayed.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{TOLERANCES, agree, event, methods_at, run_by, words};

const G: f64 = 9.81;

/// All methods, with the error that they keep over runs in which a slip decays.
pub(super) const METHODS: [(&str, f64); 8] = [
    ("auto", 100.0),
    ("taylor", 100.0),
    ("dop853", 100.0),
    ("dopri5", 100.0),
    ("verner98", 100.0),
    ("radau5", 300.0),
    ("rk4:2e-3", 0.0),
    ("gauss6:5e-3", 0.0),
];
/// What fixed steps keep.
pub(super) const FIXED: f64 = 1e-9;

/// A disc set down on a wet floor, which spins it up.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    define(foot = der(x) - radius * der(phi)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass * radius^2 / 4 * der(phi)^2,
    potential = mass * gravity * y,
    contact(floor: y >= radius),
    friction(film on floor: slip = foot, static = 0, kinetic = wet * sqrt(slip^2)),
    start(thrown: y = radius, der(x) = speed),
)]
struct Disc {
    mass: f64,
    radius: f64,
    gravity: f64,
    wet: f64,
    speed: f64,
}

#[test]
fn a_slip_that_decays() {
    let scene = Disc {
        mass: 2.0,
        radius: 0.25,
        gravity: G,
        wet: 0.2,
        speed: 3.0,
    };
    // 1/m + r²/(m r²/2) = 3/m is how easily the foot moves.
    let (rate, until) = (3.0 * scene.wet * G, 12.0);
    let left = |t: f64| (-rate * t).exp();
    let x = scene.speed * (2.0 / 3.0 * until + (1.0 - left(until)) / (3.0 * rate));
    for ((method, times), tolerance) in methods_at(METHODS, TOLERANCES) {
        let run = run_by(&scene, (method, tolerance), scene.at(Disc::THROWN), until);
        let what = format!("{method} at {tolerance:e}");
        assert!(words(&run).is_empty(), "{what}: {:?}", words(&run));
        assert!(run.final_mode().slips(Disc::FILM), "{what}");
        agree(
            &what,
            run.final_state().q(Disc::X),
            x,
            (times * tolerance).max(FIXED),
        );
    }
}

/// A block on a spring, in a film of oil.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = stiffness/2 * x^2 + gravity * y,
    contact(bed: y >= 0),
    friction(oil on bed: slip = der(x), static = 0, kinetic = wet * abs(der(x))),
)]
struct Oiled {
    stiffness: f64,
    gravity: f64,
    wet: f64,
}

#[test]
fn a_slip_that_passes_zero_reverses_there() {
    let scene = Oiled {
        stiffness: 4.0,
        gravity: G,
        wet: 0.02,
    };
    let decay = 0.5 * scene.wet * G;
    let turn = core::f64::consts::PI / (scene.stiffness - decay * decay).sqrt();
    for ((method, times), tolerance) in methods_at(METHODS, TOLERANCES) {
        let run = run_by(
            &scene,
            (method, tolerance),
            state(&[1.0, 0.0], &[0.0; 2]),
            10.0,
        );
        let what = format!("{method} at {tolerance:e}");
        let turns = run
            .events()
            .iter()
            .filter(|e| e.kind == EventKind::Reverses);
        let turns: Vec<f64> = turns.map(|e| e.time).collect();
        assert_eq!(turns.len(), 6, "{what}: {:?}", words(&run));
        for (k, time) in turns.iter().enumerate() {
            agree(
                &what,
                *time,
                (k + 1) as f64 * turn,
                (times * tolerance).max(FIXED),
            );
        }
    }
}

#[test]
fn a_slip_that_creeps() {
    let scene = Oiled {
        stiffness: 0.05,
        gravity: G,
        wet: 0.5,
    };
    // x = a e^(slow t) + b e^(fast t): pushed away, it turns once, and creeps back for minutes.
    let half = 0.5 * scene.wet * G;
    let root = (half * half - scene.stiffness).sqrt();
    let (slow, fast) = (root - half, -root - half);
    let (x, v) = (-1.0, -0.5);
    let b = (v - slow * x) / (fast - slow);
    let a = x - b;
    let turn = (-b * fast / (a * slow)).ln() / (slow - fast);
    let until: f64 = 400.0;
    let end = a * (slow * until).exp() + b * (fast * until).exp();
    for ((method, times), tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
        let run = run_by(
            &scene,
            (method, tolerance),
            state(&[x, 0.0], &[v, 0.0]),
            until,
        );
        let what = format!("{method} at {tolerance:e}");
        assert_eq!(words(&run).len(), 2, "{what}: {:?}", words(&run));
        let allowed = (times * tolerance).max(FIXED);
        agree(&what, event(&run, "oil", "reverses").time, turn, allowed);
        agree(&what, run.final_state().q(Oiled::X), end, allowed);
    }
}

/// A puck on a spring, on a table with a film of water.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3]),
    kinetic = (der(x[0])^2 + der(x[1])^2 + der(x[2])^2) / 2,
    potential = stiffness/2 * (x[0]^2 + x[1]^2) + gravity * x[2],
    contact(table: x[2] >= 0),
    friction(film on table: slip = (der(x[0]), der(x[1])), static = 0, kinetic = wet * norm(slip)),
)]
struct Puck {
    stiffness: f64,
    gravity: f64,
    wet: f64,
}

#[test]
fn a_slip_in_space_does_not_come_to_rest() {
    let scene = Puck {
        stiffness: 4.0,
        gravity: G,
        wet: 0.3,
    };
    let decay = 0.5 * scene.wet * G;
    let rate = (scene.stiffness - decay * decay).sqrt();
    let until = 25.0;
    // x″ + 2 d x′ + k x = 0 in both directions, from x₀ and v₀.
    let swings = |x: f64, v: f64| {
        let (sin, cos) = (rate * until).sin_cos();
        (-decay * until).exp() * (x * cos + (v + decay * x) / rate * sin)
    };
    let start = state(&[1.0, 0.2, 0.0], &[0.0, 1.5, 0.0]);
    for ((method, times), tolerance) in methods_at(METHODS, TOLERANCES) {
        let run = run_by(&scene, (method, tolerance), start.clone(), until);
        let what = format!("{method} at {tolerance:e}");
        assert!(words(&run).is_empty(), "{what}: {:?}", words(&run));
        for (k, (x, v)) in [(1.0, 0.0), (0.2, 1.5)].into_iter().enumerate() {
            let found = run.final_state().q(Puck::X[k]);
            agree(&what, found, swings(x, v), (times * tolerance).max(FIXED));
        }
    }
}

/// A crate on a spring, on a moving belt, whose one coefficient is a function of the slip.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = stiffness/2 * x^2,
    friction(rub: slip = der(x) - belt, normal = gravity, static = dry * exp(-abs(slip)) + wet * sqrt(slip^2)),
)]
struct Crate {
    stiffness: f64,
    gravity: f64,
    belt: f64,
    dry: f64,
    wet: f64,
}

/// `static` stands for both coefficients, and while a friction sticks its slip is zero.
#[test]
fn one_coefficient_that_depends_on_the_slip() {
    let held = Crate {
        stiffness: 4.0,
        gravity: G,
        belt: 0.1,
        dry: 0.3,
        wet: 0.02,
    };
    // A crate that is carried along is torn off where the spring pulls with the static coefficient at rest.
    let torn = held.dry * G / held.stiffness;
    let viscous = Crate {
        belt: 0.0,
        dry: 0.0,
        ..held.clone()
    };
    let decay = 0.5 * viscous.wet * G;
    let rate = (viscous.stiffness - decay * decay).sqrt();
    let until: f64 = 10.0;
    let (sin, cos) = (rate * until).sin_cos();
    let x = (-decay * until).exp() * (cos + decay / rate * sin);
    for ((method, times), tolerance) in methods_at(METHODS, TOLERANCES) {
        let what = format!("{method} at {tolerance:e}");
        let allowed = (times * tolerance).max(FIXED);
        let start = state(&[0.0], &[held.belt]);
        let run = run_by(&held, (method, tolerance), start, 10.0);
        let first = &run.events()[0];
        assert_eq!(first.kind.word(), "slips", "{what}");
        agree(&what, first.q(Crate::X), torn, allowed);
        let start = state(&[1.0], &[0.0]);
        let run = run_by(&viscous, (method, tolerance), start, until);
        agree(&what, run.final_state().q(Crate::X), x, allowed);
    }
}

/// A hoop with a load on its rim, on ice.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    define(load = [x + radius*sin(turn), y + radius*cos(turn)]),
    kinetic = mass/2*(der(x)^2 + der(y)^2 + radius^2*der(turn)^2) + (der(load[0])^2 + der(load[1])^2)/2,
    potential = mass*gravity*y + gravity*load[1],
    contact(floor: y >= radius),
    friction(grip on floor: slip = der(x) - radius*der(turn), static = mu),
)]
struct Hoop {
    mass: f64,
    radius: f64,
    gravity: f64,
    mu: f64,
}

/// Hung still with its load one rounding off the lowest point it has no slip but errors, which begin below zero: the run goes on.
#[test]
fn a_slip_that_is_all_error_ends_nothing() {
    for (mass, radius) in [(0.2, 0.5), (1.0, 0.3), (3.0, 1.7)] {
        let hoop = Hoop {
            mass,
            radius,
            gravity: G,
            mu: 0.0,
        };
        for tolerance in [1e-9, 1e-12, 1e-13, 1e-14] {
            for off in [0.0, 1e-14, -1e-13] {
                let start = state(&[0.0, radius, core::f64::consts::PI + off], &[0.0; 3]);
                let run = run_by(&hoop, ("taylor", tolerance), start, 3.0);
                let turn = run.final_state().q(Hoop::TURN) - core::f64::consts::PI;
                let allowed = f64::max(tolerance, 1e-12);
                assert!(turn.abs() < allowed, "{tolerance:e} {off:e}: {turn:e}");
            }
        }
    }
}
