//! Projections onto constraints: least in the mass metric, and made wherever rows join.

use super::state;
use lagrange_core::__private::equations::Turn;
use lagrange_core::__private::program::Selection;
use lagrange_core::prelude::*;
use lagrange_core::system::System;
use lagrange_tests::equations::Equations;
use lagrange_tests::{Random, agree, all_agree};
use nalgebra::{DMatrix, DVector};

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

/// A plank that hangs on a crank and on a string; its centre of mass lies beside its reference point.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta, phi),
    kinetic = mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(theta)^2 + crank/2*der(phi)^2
        + mass*offset*der(theta)*(der(y)*cos(theta) - der(x)*sin(theta)),
    potential = mass*gravity*(y + offset*sin(theta)),
    constraint(end_x: x - cos(theta) == radius*cos(phi)),
    constraint(end_y: y - sin(theta) == radius*sin(phi)),
    constraint(string: x^2 + y^2 == length^2),
)]
struct Plank {
    mass: f64,
    inertia: f64,
    crank: f64,
    offset: f64,
    radius: f64,
    length: f64,
    gravity: f64,
}

/// Δv = −M⁻¹ Aᵀ (A M⁻¹ Aᵀ)⁻¹ ġ, by nalgebra from the matrices that the interpreter gives.
#[test]
fn the_change_of_the_velocities_that_functions_give_is_the_least_in_the_mass_metric() {
    let plank = Plank {
        mass: 0.8,
        inertia: 0.9,
        crank: 3.0,
        offset: 0.4,
        radius: 0.5,
        length: 1.7,
        gravity: 9.81,
    };
    let structures = Plank::MODES.iter().enumerate();
    let all_act = structures.clone().find(|(_, s)| s.left_out.is_none());
    let (at, structure) = all_act.expect("functions of the mode");
    assert_eq!(structure.values, structure.rows + 4);
    let needs = [u64::MAX; 2];
    let held = Selection {
        needs: &needs,
        branches: &[],
    };
    let mut constants = vec![0.0; structure.constants];
    assert!(plank.mode_constants(at, &held, &[], &mut constants));
    let mode = Mode::open(plank.description());
    let mut random = Random::new(3);
    for _ in 0..20 {
        let mut four = || -> Vec<f64> { (0..4).map(|_| random.between(-1.0, 1.0)).collect() };
        let (q, v) = (four(), four());
        let mut values = vec![0.0; structure.values];
        let mut turns = vec![Turn::none(); structure.turns];
        let mut rates = [0.0; 4];
        let value = Plank::mode_values::<f64>()[at];
        assert!(value(
            &constants,
            &held,
            (0.0, &q, &v),
            &mut rates,
            Some(&mut values),
            &mut turns
        ));
        let equations = Equations::of(&plank, &mode, &q, &v);
        let mass = DMatrix::from_fn(4, 4, |i, j| equations.mass[i][j]);
        let rows = DMatrix::from_fn(3, 4, |i, j| equations.jacobian[i][j]);
        let rate = DVector::from_column_slice(&equations.velocity);
        let spread = mass.cholesky().expect("inertia").solve(&rows.transpose());
        let force = (rows * &spread)
            .lu()
            .solve(&rate)
            .expect("independent rows");
        let change = -spread * force;
        all_agree(
            "changes",
            &values[structure.rows..],
            change.as_slice(),
            1e-11,
        );
    }
}
