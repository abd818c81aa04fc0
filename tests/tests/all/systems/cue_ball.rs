//! A ball on a level table that slides and spins: the direction of its slip never turns, so its path is a parabola until it rolls.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, all_agree, closure, event, run, words};

/// A solid ball; a and b are the integrals of its angular velocity about x and y, which is all that a ball needs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z, a, b),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2) + mass * radius^2 / 5 * (der(a)^2 + der(b)^2),
    potential = mass * gravity * z,
    contact(cloth: z >= radius),
    friction(grip on cloth: slip = (der(x) - radius * der(b), der(y) + radius * der(a)), static = mu_static, kinetic = mu_kinetic),
)]
struct CueBall {
    mass: f64,
    radius: f64,
    gravity: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

const BALL: CueBall = CueBall {
    mass: 0.17,
    radius: 0.028,
    gravity: 9.81,
    mu_static: 0.2,
    mu_kinetic: 0.2,
};

#[test]
fn the_path_is_a_parabola_until_it_rolls() {
    let r = BALL.radius;
    for (v, spin) in [
        ([2.0, 0.0], [60.0, 40.0]),
        ([1.0, 1.5], [-30.0, 80.0]),
        ([0.0, 0.0], [50.0, 0.0]),
    ] {
        let start = state(
            &[0.0, 0.0, r, 0.0, 0.0],
            &[v[0], v[1], 0.0, spin[0], spin[1]],
        );
        let trajectory = run(&BALL, start, 3.0);
        assert_eq!(words(&trajectory), ["grip sticks"]);
        let slip = [v[0] - r * spin[1], v[1] + r * spin[0]];
        let size = slip[0].hypot(slip[1]);
        let (mu_g, u) = (0.2 * 9.81, slip.map(|s| s / size));
        let time = 2.0 / 7.0 * size / mu_g;
        let rolls = event(&trajectory, "grip", "sticks");
        agree("time until it rolls", rolls.time, time, 1e-13);
        let velocity = [0, 1].map(|i| v[i] - mu_g * time * u[i]);
        all_agree("velocity", &rolls.state_after.v[..2], &velocity, 1e-13);
        let place = [0, 1].map(|i| v[i] * time - 0.5 * mu_g * time * time * u[i]);
        all_agree("place", &rolls.state.q[..2], &place, 1e-13);
        let force = u.map(|u| -0.2 * 0.17 * 9.81 * u);
        all_agree("friction before", &rolls.forces[1..], &force, 1e-12);
        all_agree("friction after", &rolls.forces_after[1..], &[0.0; 2], 1e-13);
        let end = trajectory.final_state();
        let slip = (end.v[0] - r * end.v[4]).hypot(end.v[1] + r * end.v[3]);
        assert!(slip < 1e-15, "{slip}");
        assert!(closure(&trajectory) < 1e-12);
    }
}
