//! Conditions that depend on others: `abs`, `max` and `min` of what changes with an `if` are on their new sides before anything else is decided.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, words};

/// A block that is pulled with less than friction holds. A magnet presses it whose current alternates.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(rope: x = pull),
    friction(grip: slip = der(x), normal = abs(if(sin(rate * t + phase) >= 0, current, -current)), static = 1, kinetic = kinetic),
    start(go),
)]
struct Magnet {
    pull: f64,
    current: f64,
    rate: f64,
    phase: f64,
    kinetic: f64,
}

/// A block whose drive is a controller with a limit; what it is to follow jumps to and fro.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = y,
    force(drive: x = min(max(10 * (sign(sin(rate * t + phase)) - x), -most), most)),
    contact(table: y >= 0),
    friction(grip on table: slip = der(x), static = 1, kinetic = kinetic),
    start(go),
)]
struct Servo {
    most: f64,
    rate: f64,
    phase: f64,
    kinetic: f64,
}

#[test]
fn what_is_held_stays_held_where_conditions_jump() {
    let mut random = Random::new(561);
    for _ in 0..15 {
        let current = random.between(0.5, 3.0);
        let [rate, phase, kinetic] =
            [(0.5, 10.0), (0.0, 3.0), (0.1, 1.0)].map(|(low, high)| random.between(low, high));
        let share = random.between(0.1, 0.95);
        let magnet = Magnet {
            pull: random.sign() * share * current,
            current,
            rate,
            phase,
            kinetic,
        };
        let servo = Servo {
            most: share,
            rate,
            phase,
            kinetic,
        };
        let pairs = methods_at(METHODS, TOLERANCES);
        for pair in pairs {
            rests(
                format!("{magnet:?} by {pair:?}"),
                &run_by(&magnet, pair, state(&[0.0], &[0.0]), 4.0),
            );
            rests(
                format!("{servo:?} by {pair:?}"),
                &run_by(&servo, pair, state(&[0.0; 2], &[0.0; 2]), 4.0),
            );
        }
    }
}

fn rests(what: String, run: &Trajectory) {
    let of_grip: Vec<String> = words(run)
        .into_iter()
        .filter(|word| word.starts_with("grip"))
        .collect();
    assert_eq!(of_grip, Vec::<String>::new(), "{what}");
    let state = run.final_state();
    assert_eq!((state.q[0], state.v[0]), (0.0, 0.0), "{what}");
    certified(what, run);
}

/// A body bounces between two walls; what drives a block on a rough floor depends on how fast it is, up to a limit.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, block),
    kinetic = (der(x)^2 + der(block)^2) / 2,
    contact(left: x >= 0, restitution = 1),
    contact(right: x <= 1, restitution = 1),
    force(drive: block = min(abs(gain * der(x)), most)),
    friction(grip: slip = der(block), limit = 1),
    start(go: x = 1/2, der(x) = 1),
)]
struct Blower {
    gain: f64,
    most: f64,
}

/// Impacts turn the velocity round: the size of the push is what it was.
#[test]
fn what_is_held_stays_held_where_velocities_jump() {
    for most in [0.3, 0.7, 0.9] {
        let blower = Blower { gain: 2.0, most };
        for pair in methods_at(METHODS, [1e-9]) {
            let run = run_by(&blower, pair, state(&[0.5, 0.0], &[1.0, 0.0]), 9.7);
            let what = format!("{most} by {pair:?}");
            assert!(
                words(&run).iter().all(|word| !word.contains("grip")),
                "{what}"
            );
            assert_eq!(run.final_state().q[1], 0.0, "{what}");
            certified(what, &run);
        }
    }
}

/// A block at the edge of ice, which begins where x ≥ edge; it is pulled along.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(rope: x = pull),
    friction(grip: slip = der(x), normal = 10, static = if(x >= edge, ice, ground)),
)]
struct Shore {
    edge: f64,
    pull: f64,
    ice: f64,
    ground: f64,
}

/// At the edge itself what is declared for equality acts.
#[test]
fn at_the_edge_of_ice_it_slides_onto_the_ice() {
    for (edge, pull, ice) in [(1.0, 2.0, 0.05), (0.3, 4.0, 0.1), (-2.0, 1.0, 0.0)] {
        for pair in methods_at(METHODS, TOLERANCES) {
            let shore = Shore {
                edge,
                pull,
                ice,
                ground: 0.5,
            };
            let what = format!("{shore:?} by {pair:?}");
            let run = run_by(&shore, pair, state(&[edge], &[0.0]), 2.0);
            certified(&what, &run);
            agree(
                what,
                run.final_state().q[0],
                edge + (pull - 10.0 * ice) * 2.0,
                1e-12,
            );
        }
    }
}

/// What moves is the same whether its load is written with an outer condition or without.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    friction(outer: slip = der(x) - 1, normal = abs(if(sin(rate * t) >= 0, high, -low)), static = 0.3),
    friction(plain: slip = der(y) - 1, normal = if(sin(rate * t) >= 0, high, low), static = 0.3),
    force(one: x = 0.4),
    force(two: y = 0.4),
    start(go),
)]
struct Loads {
    rate: f64,
    high: f64,
    low: f64,
}

#[test]
fn loads_with_an_outer_condition_are_those_without() {
    let mut random = Random::new(562);
    for _ in 0..10 {
        let loads = Loads {
            rate: random.between(0.5, 3.0) * PI,
            high: random.between(0.5, 3.0),
            low: random.between(0.1, 2.0),
        };
        for pair in methods_at(METHODS, [1e-9]) {
            let run = run_by(&loads, pair, state(&[0.0; 2], &[0.0; 2]), 3.0);
            let [x, y] = [0, 1].map(|i| run.final_state().q[i]);
            agree(format!("{loads:?} by {pair:?}"), x, y, 1e-8);
            certified(format!("{loads:?} by {pair:?}"), &run);
        }
    }
}
