//! Projections onto constraints: least in the mass metric, and made wherever rows join.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, all_agree};

/// Three unequal masses, tied by one linear constraint.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = (m1 * der(x)^2 + m2 * der(y)^2 + m3 * der(z)^2) / 2,
    constraint(tie: x + 2*y - z == 1),
)]
struct Tied {
    m1: f64,
    m2: f64,
    m3: f64,
}

/// Δ = −M⁻¹ a (a·q − 1)/(a·M⁻¹ a), and the same for the velocities.
#[test]
fn a_start_is_projected_in_the_mass_metric() {
    let masses = [0.5, 3.0, 20.0];
    let [m1, m2, m3] = masses;
    let row = [1.0, 2.0, -1.0];
    let (q, v) = ([0.4, 0.3, 0.2], [0.7, -0.1, 0.9]);
    let motion = Simulation::new(&Tied { m1, m2, m3 })
        .project_start(true)
        .run(state(&q, &v), 0.0..0.0);
    let motion = motion.expect("a start that can be projected");
    let effect: f64 = (0..3).map(|i| row[i] * row[i] / masses[i]).sum();
    let moved = |x: [f64; 3], aim: f64| {
        let residual: f64 = (0..3).map(|i| row[i] * x[i]).sum::<f64>() - aim;
        [0, 1, 2].map(|i| x[i] - row[i] / masses[i] * residual / effect)
    };
    let start = motion.first_state();
    all_agree("positions", &start.q, &moved(q, 1.0), 1e-14);
    all_agree("velocities", &start.v, &moved(v, 0.0), 1e-14);
}

/// A bob that falls into its string.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(string: length >= sqrt(x^2 + y^2)),
)]
struct Bob {
    mass: f64,
    gravity: f64,
    length: f64,
}

#[test]
fn after_a_landing_the_constraint_holds_to_rounding_at_any_tolerance() {
    let scene = Bob {
        mass: 0.7,
        gravity: 9.81,
        length: 1.3,
    };
    for tolerance in [1e-3, 1e-5, 1e-8] {
        for x in [0.3, 0.7, 1.1] {
            let motion = Simulation::new(&scene)
                .tolerance(tolerance)
                .run(state(&[x, 0.4], &[0.2, 1.0]), 0.0..2.0)
                .expect("a run");
            let mut landings = motion.events().iter();
            let landing = landings.find(|e| e.kind == EventKind::Closed);
            let State { q, v, .. } = &landing.expect("the string tightens").state_after;
            agree("length", q[0].hypot(q[1]), scene.length, 4e-16);
            agree("rate", q[0] * v[0] + q[1] * v[1], 0.0, 4e-15);
        }
    }
}
