//! Rigid bodies on unit quaternions: free in space, and where hardly any force acts.

use lagrange_core::prelude::*;
use lagrange_tests::agree;

/// A ball rolls along a wall that it only touches: nothing presses it there, and forces are what rounding leaves.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    attitude(body: q),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass * radius^2 / 5 * (body.body_rate[0]^2 + body.body_rate[1]^2 + body.body_rate[2]^2),
    contact(wall: x <= side),
    friction(floor: slip = (der(x) - radius * body.space_rate[1], der(y) + radius * body.space_rate[0]),
        normal = mass * 9.81, static = mu),
)]
struct Rolling {
    mass: f64,
    radius: f64,
    side: f64,
    mu: f64,
}

#[test]
fn a_ball_that_rolls_along_a_wall_is_certified() {
    let scene = Rolling {
        mass: 0.2,
        radius: 0.05,
        side: 0.15,
        mu: 0.3,
    };
    for (speed, spin) in [(0.28, 0.0), (0.3, 4.0), (-1.1, 7.0)] {
        for tolerance in [1e-6, 1e-12] {
            // Rolling: ω = (−v/r, 0, spin).
            let rates = [0.0, -speed / scene.radius / 2.0, 0.0, spin / 2.0];
            let start = State::new(
                vec![0.15, 0.0, 1.0, 0.0, 0.0, 0.0],
                [0.0, speed].into_iter().chain(rates).collect(),
            );
            let simulation = Simulation::new(&scene).tolerance(tolerance);
            let run = simulation.run(start, 0.0..2.0).expect("a run");
            let end = run.final_state().q(Rolling::Y);
            agree("y", end, 2.0 * speed, 10.0 * tolerance);
            let certificate = run.verify(0).expect("recorded");
            assert!(certificate.holds(), "{certificate}");
        }
    }
}

/// A body with three moments of inertia, free in space.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    attitude(body: q),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2) + sum(k in 0..3: inertia[k]/2 * body.body_rate[k]^2),
    potential = mass * 9.81 * z,
)]
struct Free {
    mass: f64,
    inertia: [f64; 3],
}

/// M is singular along the quaternion, and no order of pivots would do; with the condition of unit length it is positive definite, whatever the
/// attitude and however different the inertias. The solver of the core, which would make factors, is not asked.
#[test]
fn a_free_body_runs_by_its_functions() {
    for inertia in [[1.0, 1.0, 1.0], [0.02, 0.5, 0.51], [3e-6, 2e-6, 4e-6]] {
        let scene = Free { mass: 0.3, inertia };
        for attitude in [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 0.6, 0.0, 0.8],
            [0.5, -0.5, 0.5, 0.5],
        ] {
            let [a, b, c, d] = attitude;
            let mut q = vec![0.0; 3];
            q.extend(attitude);
            // ½ q ∘ ω
            let [u, v, w] = [0.4, -0.9, 0.7];
            let rates = [
                -b * u - c * v - d * w,
                a * u + c * w - d * v,
                a * v - b * w + d * u,
                a * w + b * v - c * u,
            ];
            let start = [0.1, 0.2, 0.3].into_iter();
            let start = start.chain(rates.map(|rate| 0.5 * rate)).collect();
            let run = Simulation::new(&scene).run(State::new(q, start), 0.0..0.2);
            let run = run.expect("a run");
            assert_eq!(run.work().factorizations, 0, "{inertia:?} {attitude:?}");
            let certificate = run.verify(0).expect("recorded");
            assert!(certificate.holds(), "{certificate}");
        }
    }
}
