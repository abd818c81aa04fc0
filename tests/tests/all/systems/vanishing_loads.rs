//! Loads of a direction inside the friction cone that pass through zero: load and friction vanish together, and nothing slips.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    Random, SINGLE_METHODS, TOLERANCES, agree, certified, methods_at, run_by, words,
};

/// A bead in a guide, held by one friction; and the same held by two that share the load.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    force(load: (slope * (size * sin(rate * t) + shift), size * sin(rate * t) + shift) at (x, y)),
    constraint(guide: y == 0),
    friction(rub on guide: slip = der(x), static = mu, kinetic = share * mu),
    friction(half on guide: slip = der(x), static = mu, kinetic = share * mu),
)]
struct Guide {
    slope: f64,
    size: f64,
    rate: f64,
    shift: f64,
    mu: f64,
    share: f64,
}

#[test]
fn a_bead_whose_load_passes_zero_inside_the_cone_stays() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(12);
        for case in 0..8 {
            let mu = random.between(0.1, 0.4);
            let guide = Guide {
                slope: 2.0 * mu * random.between(-0.95, 0.95),
                size: random.between(5.0, 30.0),
                rate: random.between(0.5, 4.0),
                shift: random.between(-4.0, 4.0),
                mu,
                share: [1.0, 0.7][case % 2],
            };
            let start = || state(&[0.0; 2], &[0.0; 2]);
            let held_twice = run_by(&guide, (method, tolerance), start(), 10.0);
            let what = format!("{method} at {tolerance:e}, {case}");
            agree(&what, held_twice.final_state().q[0], 0.0, 1e-12);
            assert!(
                words(&held_twice).is_empty(),
                "{what}: {guide:?} {:?}",
                words(&held_twice)
            );
            certified(&what, &held_twice);
            // One friction that holds as much.
            let alone = Guide {
                mu: 2.0 * mu,
                ..guide
            };
            let simulation = Simulation::new(&alone).effects(Effects::all().without(Guide::HALF));
            let held_once = simulation.run(start(), 0.0..10.0).expect("a run");
            agree(&what, held_once.final_state().q[0], 0.0, 1e-12);
            certified(&what, &held_once);
        }
    }
}

/// A drawer on two shoes, pulled beside its middle so far that it jams: the couple presses both shoes, and friction holds at both.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    kinetic = (der(x)^2 + der(y)^2) / 2 + inertia/2 * der(phi)^2,
    force(pull: x = size * sin(rate * t) + shift),
    force(couple: phi = arm * (size * sin(rate * t) + shift)),
    constraint(front: y + length * phi == 0),
    constraint(back: y - length * phi == 0),
    friction(fore on front: slip = der(x), static = mu, kinetic = share * mu),
    friction(aft on back: slip = der(x), static = mu, kinetic = share * mu),
)]
struct Drawer {
    inertia: f64,
    length: f64,
    arm: f64,
    size: f64,
    rate: f64,
    shift: f64,
    mu: f64,
    share: f64,
}

/// Both shoes press with P e/2l: it jams where 2 μ e/2l > 1.
#[test]
fn a_jammed_drawer_stays_jammed_while_its_load_turns() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(3);
        for case in 0..6 {
            let (mu, length) = (random.between(0.1, 0.9), random.between(0.1, 0.5));
            let drawer = Drawer {
                inertia: random.between(0.1, 1.0),
                length,
                arm: length / mu * random.between(1.05, 3.0),
                size: random.between(5.0, 40.0),
                rate: random.between(1.0, 7.0),
                shift: random.between(-4.0, 4.0),
                mu,
                share: [1.0, 0.7][case % 2],
            };
            let run = run_by(
                &drawer,
                (method, tolerance),
                state(&[0.0; 3], &[0.0; 3]),
                4.0,
            );
            let what = format!("{method} at {tolerance:e}, {case}");
            agree(&what, run.final_state().q[0], 0.0, 1e-12);
            assert!(
                words(&run).is_empty(),
                "{what}: {drawer:?} {:?}",
                words(&run)
            );
            certified(&what, &run);
        }
    }
}

/// A load that only touches zero, once in each turn.
#[test]
fn a_bead_whose_load_touches_zero_inside_the_cone_stays() {
    let mut random = Random::new(567);
    for case in 0..24 {
        let mu = random.between(0.2, 0.8);
        let size = random.between(5.0, 30.0);
        let guide = Guide {
            slope: mu * [0.0, 0.5, 0.9, -0.97][case % 4],
            size,
            rate: [1.0, 2.0, 3.0, random.between(0.5, 4.0)][case / 6],
            shift: [size, -size][case % 2],
            mu,
            share: [1.0, 0.6][case / 2 % 2],
        };
        for tolerance in [1e-9, 1e-12] {
            let effects = Effects::all().without(Guide::HALF);
            let simulation = Simulation::new(&guide)
                .effects(effects)
                .tolerance(tolerance);
            let run = simulation.run(state(&[0.0; 2], &[0.0; 2]), 0.0..10.0);
            let run = run.expect("a run");
            let what = format!("{guide:?} at {tolerance:e}");
            assert!(words(&run).is_empty(), "{what}: {:?}", words(&run));
            agree(&what, run.final_state().q[0], 0.0, 1e-12);
            certified(&what, &run);
        }
    }
}
