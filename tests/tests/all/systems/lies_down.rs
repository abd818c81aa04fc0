//! A chain of three links, its end on a hook, falls on a smooth floor and lies down: at last two links are in one line, the position in which their forces are
//! not determined.

use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, certified, methods_at};

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(theta[3]),
    define(
        x[k in 0..3] = sum(i in 0..k+1: length[i] * sin(theta[i])),
        y[k in 0..3] = sum(i in 0..k+1: -length[i] * cos(theta[i])),
    ),
    kinetic = sum(k in 0..3: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..3: mass[k] * gravity * y[k]),
    contact(floor[k in 0..3]: y[k] >= -depth, restitution = bounce),
    friction(grip[k in 0..3] on floor[k]: slip = der(x[k]), static = mu),
    start(thrown: theta = [1.7565, 2.1667, 2.1405], der(theta) = [-1.4663, -0.378, 1.0664]),
)]
struct Chain {
    mass: [f64; 3],
    length: [f64; 3],
    depth: f64,
    bounce: f64,
    mu: f64,
    gravity: f64,
}

#[test]
fn a_chain_lies_down() {
    let chain = |mass, length, [depth, mu, gravity]: [f64; 3]| Chain {
        mass,
        length,
        depth,
        bounce: 0.38,
        mu,
        gravity,
    };
    let chains = [
        chain(
            [2.2416, 1.1345, 1.8002],
            [1.55146, 0.589211, 0.860602],
            [0.630628, 0.0135228, 8.13997],
        ),
        chain(
            [1.71589, 1.22749, 0.561184],
            [0.577399, 1.51278, 1.39995],
            [0.592234, 0.0201196, 13.5034],
        ),
        chain(
            [1.26078, 1.01331, 1.48636],
            [1.52884, 0.94319, 1.32883],
            [1.28173, 0.0106792, 13.0078],
        ),
    ];
    for chain in chains {
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let simulation = Simulation::new(&chain)
                .method(method)
                .tolerance(tolerance)
                .project_start(true);
            let trajectory = simulation.run(chain.at(Chain::THROWN), 0.0..3.0);
            let trajectory = trajectory.unwrap_or_else(|failure| panic!("{method}: {failure}"));
            certified(format!("{method} {tolerance:e}"), &trajectory);
        }
    }
}
