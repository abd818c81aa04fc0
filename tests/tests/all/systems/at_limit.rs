//! Forces that are all that there is of them, to the last bit or a few less or more: blocks that friction just holds, beads that press with nothing.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    Random, SINGLE_METHODS, TOLERANCES, agm, agree, certified, methods_at, run_by,
};

/// A block on a spring on a rough floor, under a load.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y + stiffness/2 * x^2,
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x), static = mu),
    force(pull: x = load),
)]
struct Held {
    mass: f64,
    gravity: f64,
    stiffness: f64,
    mu: f64,
    load: f64,
}

/// Whether it is held or creeps, within rounding it stays where it is, by any method and at any tolerance.
#[test]
fn a_block_at_the_edge_of_its_dead_band_stays() {
    for (method, tolerance) in methods_at(
        [
            "taylor", "dop853", "dopri5", "verner98", "radau5", "rk4:0.01",
        ],
        TOLERANCES,
    ) {
        let mut random = Random::new(9);
        for _ in 0..50 {
            let scene = Held {
                mass: random.between(0.2, 3.0),
                gravity: random.between(1.0, 20.0),
                stiffness: random.between(1.0, 50.0),
                mu: random.between(0.1, 0.9),
                load: random.between(-5.0, 5.0),
            };
            let most = random.sign() * scene.mu * scene.mass * scene.gravity;
            let most = most * (1.0 + random.between(-1e-14, 1e-14));
            let x = (scene.load + most) / scene.stiffness;
            let start = state(&[x, 0.0], &[0.0, 0.0]);
            let motion = run_by(&scene, (method, tolerance), start, 1.0);
            let moved = (motion.final_state().q[0] - x).abs();
            assert!(moved < 1e-11, "{method} {tolerance:e}: {moved}");
        }
    }
}

/// A bead inside a hoop whose rim gives way beyond its radius: pressed against it, the bead stays where the branch of `max` changes. A force
/// across drives steps that do not end where it is at rest.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    potential = gravity * y + stiffness * max(x^2 + y^2 - radius^2, 0)^2,
    contact(hoop: x^2 + y^2 <= radius^2),
    force(drive: z = sin(20 * t)),
)]
struct Rim {
    gravity: f64,
    radius: f64,
    stiffness: f64,
}

/// Let go level with the centre it comes back to that height, at rest and pressing with nothing: whether it then parts from the rim by the error
/// of the motion or not, gap and branch agree on it. T = 2π √(r/g) / agm(1, √½).
#[test]
fn a_bead_comes_back_to_where_it_presses_with_nothing() {
    let rim = Rim {
        gravity: 9.81,
        radius: 0.7,
        stiffness: 300.0,
    };
    let period =
        core::f64::consts::TAU * (rim.radius / rim.gravity).sqrt() / agm(1.0, 0.5_f64.sqrt());
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let start = state(&[rim.radius, 0.0, 0.0], &[0.0; 3]);
        let motion = run_by(&rim, (method, tolerance), start, 2.0 * period);
        let end = motion.final_state();
        let within = 200.0 * tolerance;
        let what = format!("{method} {tolerance:.0e}");
        agree(&what, end.q[0], rim.radius, within);
        agree(&what, end.q[1], 0.0, within);
        agree(&what, end.v[1], 0.0, within);
        certified(&what, &motion);
    }
}
