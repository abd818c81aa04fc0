//! Loads of a direction inside the friction cone that pass through zero: load and friction vanish together, and nothing slips.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    Random, SINGLE_METHODS, TOLERANCES, agree, certified, methods_at, run_by, words,
};

/// A bead in a guide, held by one friction; and the same held by two that share the load.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
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
    emit = data,
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

/// A load that only touches zero, once in each turn, held by one friction or by two that share it.
#[test]
fn a_bead_whose_load_touches_zero_inside_the_cone_stays() {
    let mut random = Random::new(567);
    for case in 0..24 {
        let mu = random.between(0.2, 0.8);
        let size = random.between(5.0, 30.0);
        let alone = Guide {
            slope: mu * [0.0, 0.5, 0.9, -0.97][case % 4],
            size,
            rate: [1.0, 2.0, 3.0, random.between(0.5, 4.0)][case / 6],
            shift: [size, -size][case % 2],
            mu,
            share: [1.0, 0.6][case / 2 % 2],
        };
        let together = Guide {
            mu: 0.5 * mu,
            ..alone
        };
        let one = || Effects::all().without(Guide::HALF);
        for (guide, effects, asked) in [
            (&alone, one(), ("auto", 1e-9)),
            (&alone, one(), ("auto", 1e-12)),
            (&alone, one(), ("dop853", 1e-9)),
            (&together, Effects::all(), ("auto", 1e-6)),
            (&together, Effects::all(), ("auto", 1e-9)),
            (&together, Effects::all(), ("auto", 1e-12)),
        ] {
            let simulation = Simulation::new(guide)
                .effects(effects)
                .method(asked.0.parse().expect("a method"))
                .tolerance(asked.1);
            let run = simulation.run(state(&[0.0; 2], &[0.0; 2]), 0.0..10.0);
            let run = run.expect("a run");
            let what = format!("{guide:?} by {asked:?}");
            assert!(words(&run).is_empty(), "{what}: {:?}", words(&run));
            agree(&what, run.final_state().q[0], 0.0, 1e-12);
            certified(&what, &run);
        }
    }
}

/// Two pads that share a load which falls to zero and grows again at once.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    define(load = size * abs(rate * t - 1)),
    force(push: (slope * load, load) at (x, y)),
    constraint(guide: y == 0),
    friction(near on guide: slip = der(x), static = share * mu, kinetic = 0.6 * share * mu),
    friction(far on guide: slip = der(x), static = (1 - share) * mu, kinetic = 0.6 * (1 - share) * mu),
)]
struct Pads {
    size: f64,
    rate: f64,
    slope: f64,
    mu: f64,
    share: f64,
}

/// Where the load turns, at an instant that no number is, it is rounding: it presses as it begins anew.
#[test]
fn pads_hold_where_their_load_begins_anew() {
    let mut random = Random::new(35);
    for rate in [1.0, 3.0, 5.0, 6.0, 7.0, 9.0, 11.0, 13.0] {
        for part in [0.0, 0.5, 0.9, -0.98] {
            let mu = random.between(0.2, 0.8);
            let pads = Pads {
                size: random.between(1.0, 20.0),
                rate,
                slope: part * mu,
                mu,
                share: random.between(0.1, 0.9),
            };
            for asked in [("auto", 1e-9), ("auto", 1e-12), ("dop853", 1e-9)] {
                let run = run_by(&pads, asked, state(&[0.0; 2], &[0.0; 2]), 4.0);
                let what = format!("{pads:?} by {asked:?}");
                agree(&what, run.final_state().q[0], 0.0, 1e-12);
                let slips = words(&run).iter().any(|word| word.contains("slips"));
                assert!(!slips, "{what}: {:?}", words(&run));
                certified(&what, &run);
            }
        }
    }
}
