//! A platform on six legs with springs and dampers (Stewart, "A platform with six degrees of freedom", Proceedings of the Institution of
//! Mechanical Engineers 180 (1965)). Multiplied out, what its dampers do has more terms than can be derived.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, certified, root};

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(p[3]),
    attitude(top: q),
    define(
        foot[k in 0..6] = pi/3 * k + 0.2 * (-1)^k,
        joint[k in 0..6] = pi/3 * k - 0.3 * (-1)^k,
        ahead[k in 0..6] = 0.6 * cos(joint[k]),
        aside[k in 0..6] = 0.6 * sin(joint[k]),
        x[k in 0..6] = p[0] + ahead[k] * top.axes[0][0] + aside[k] * top.axes[1][0] - cos(foot[k]),
        y[k in 0..6] = p[1] + ahead[k] * top.axes[0][1] + aside[k] * top.axes[1][1] - sin(foot[k]),
        z[k in 0..6] = p[2] + ahead[k] * top.axes[0][2] + aside[k] * top.axes[1][2],
        length[k in 0..6] = sqrt(x[k]^2 + y[k]^2 + z[k]^2),
        w = top.body_rate,
    ),
    kinetic = mass/2 * (der(p[0])^2 + der(p[1])^2 + der(p[2])^2)
        + (w[0]^2 + 1.1 * w[1]^2 + 2 * w[2]^2)/2 + 0.05 * w[0] * w[1] + 0.02 * w[0] * w[2],
    potential = mass * 9.81 * p[2] + sum(k in 0..6: stiffness/2 * (length[k] - rest)^2),
    dissipation(dampers: sum(k in 0..6: damping/2 * der(length[k])^2)),
)]
struct Platform {
    mass: f64,
    stiffness: f64,
    damping: f64,
    rest: f64,
}

#[test]
fn a_platform_on_six_legs_comes_to_rest_where_they_carry_it() {
    let scene = Platform {
        mass: 20.0,
        stiffness: 4e3,
        damping: 300.0,
        rest: 1.25,
    };
    let (s, c) = 0.1_f64.sin_cos();
    let start = state(
        &[0.05, -0.1, 1.2, c, 0.6 * s, 0.0, 0.8 * s],
        &[0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0],
    );
    let simulation = Simulation::new(&scene).tolerance(1e-10);
    let run = simulation.run(start, 0.0..8.0).expect("comes to rest");
    certified("", &run);
    // Level and in the middle, all legs are as long: m g = 6 k (rest − l) z/l, feet and joints 0.5 rad apart on circles of 1 m and 0.6 m.
    let length = |z: f64| (z * z + 1.36 - 1.2 * 0.5_f64.cos()).sqrt();
    let carried = |z: f64| 6.0 * 4e3 * (scene.rest - length(z)) * z / length(z) - 20.0 * 9.81;
    let height = root(carried, 0.9, 1.2);
    let end = run.final_state();
    agree("height", end.q[2], height, 1e-9);
    for (what, q) in [("x", 0), ("y", 1), ("lean", 4), ("tilt", 5), ("turn", 6)] {
        agree(what, end.q[q], 0.0, 1e-9);
    }
}
