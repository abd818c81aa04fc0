//! Blocks that are held by all that friction has, to the last bit or a few less or more.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, run_by};

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
    for method in [
        "taylor", "dop853", "dopri5", "verner98", "radau5", "rk4:0.01",
    ] {
        for tolerance in [1e-6, 1e-9, 1e-12] {
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
}
