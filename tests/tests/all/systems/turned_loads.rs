//! Frictions on a constraint whose force passes through zero while others help them to hold: for an instant they can hold nothing.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, SINGLE_METHODS, agree, certified, root, run_by, words};

/// A rack and its pinion at rest: a clutch holds the rack, and the mesh rubs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(s, p),
    kinetic = der(s)^2/2 + der(p)^2/2,
    constraint(mesh: s + ratio * p == 0),
    friction(clutch: slip = der(s), limit = holds),
    friction(rub on mesh: slip = der(p), static = mu, kinetic = mu/2),
    force(motor: s = drive * sin(fast * t + 2.4)),
    force(load: p = weight * sin(slow * t + 4.6)),
)]
struct Rack {
    ratio: f64,
    holds: f64,
    mu: f64,
    drive: f64,
    fast: f64,
    weight: f64,
    slow: f64,
}

/// While forces of the mesh can be found that hold everything nothing happens, also where they pass through zero.
#[test]
fn a_rack_is_held_as_the_force_of_its_mesh_turns() {
    let mut random = Random::new(86);
    for _ in 0..8 {
        let ranges = [
            (0.5, 2.0),
            (0.05, 0.4),
            (0.2, 1.5),
            (1.0, 5.0),
            (0.1, 1.2),
            (1.0, 5.0),
        ];
        let [ratio, mu, drive, fast, weight, slow] =
            ranges.map(|(low, high)| random.between(low, high));
        // More than what the motor and the load across the mesh come to.
        let holds = drive + weight / (ratio - mu).abs().max(0.1) + 0.1;
        let rack = Rack {
            ratio,
            holds,
            mu,
            drive,
            fast,
            weight,
            slow,
        };
        for method in METHODS {
            for tolerance in [1e-7, 1e-9, 1e-11] {
                let pair = (method, tolerance);
                let run = run_by(&rack, pair, state(&[0.0; 2], &[0.0; 2]), 3.0);
                certified(format!("{pair:?}"), &run);
                assert!(
                    run.events().is_empty(),
                    "{rack:?} by {pair:?}: {:?}",
                    words(&run)
                );
                assert_eq!(run.final_state().q, [0.0; 2], "{rack:?} by {pair:?}");
            }
        }
    }
}

/// A screw whose thread rubs, held by a tight nut as well.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(z, phi),
    kinetic = der(z)^2/2 + der(phi)^2/2,
    constraint(thread: z == 0.05 * phi),
    friction(rub on thread: slip = 0.2 * der(phi), static = 0.3, kinetic = 0.3),
    friction(nut: slip = der(phi), limit = holds),
    force(motor: phi = torque),
    force(load: z = drive * (t - 1)),
)]
struct Screw {
    holds: f64,
    torque: f64,
    drive: f64,
}

/// As the load of the thread passes through zero the nut alone has to hold the motor; where it cannot the screw turns for some milliseconds. In the
/// thread λ = −F then, and it slips from where 0.06 |F| + holds = |torque + 0.05 F| on.
#[test]
fn a_screw_slips_while_its_thread_is_not_pressed() {
    let mut random = Random::new(1841);
    for _ in 0..8 {
        let torque = random.between(0.3, 2.0);
        let screw = Screw {
            holds: torque - random.between(2e-3, 5e-2),
            torque,
            drive: random.between(5.0, 60.0),
        };
        let missing = |t: f64| {
            let load = screw.drive * (t - 1.0);
            0.06 * load.abs() + screw.holds - (screw.torque + 0.05 * load).abs()
        };
        let begins = root(missing, 0.0, 1.0);
        for method in SINGLE_METHODS {
            let pair = (method, 1e-9);
            let run = run_by(&screw, pair, state(&[0.0; 2], &[0.0; 2]), 2.0);
            certified(format!("{pair:?}"), &run);
            let names = words(&run);
            let what = format!("{screw:?} by {pair:?}: {names:?}");
            assert_eq!(names[..2], ["rub slips", "nut slips"], "{what}");
            agree(what, run.events()[0].time, begins, 1e-8);
        }
    }
}
