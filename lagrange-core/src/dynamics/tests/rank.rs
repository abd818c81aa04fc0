//! Singular mass matrices, dependent rows, projection.

use super::pendulum::{GROWING, PENDULUM, Pendulum, ROD, TWIN};
use super::*;
use crate::effects::Item;

const SCENE: Pendulum = Pendulum {
    mass: 1.7,
    gravity: 9.81,
    skew: 0.0,
};

fn with_rows(rows: &[usize]) -> Effects {
    let out = [ROD, TWIN, GROWING]
        .into_iter()
        .filter(|row| !rows.contains(row));
    out.fold(Effects::all(), |effects, row| {
        effects.without(Item::Constraint(row))
    })
}

/// A state on the rod.
fn state() -> ([f64; 2], [f64; 2]) {
    let (s, c) = 0.7_f64.sin_cos();
    ([s, -c], [1.3 * c, 1.3 * s])
}

/// λ of x² + y² = 1: from 0 = x ẍ + y ÿ + v².
fn tension(q: [f64; 2], v: [f64; 2]) -> f64 {
    0.5 * SCENE.mass * (SCENE.gravity * q[1] - v[0] * v[0] - v[1] * v[1])
}

#[test]
fn a_rod_pulls_with_its_textbook_force() {
    let mut dynamics = Dynamics::new(&SCENE, &with_rows(&[ROD]));
    let (q, v) = state();
    dynamics.value(0.0, &q, &v).expect("regular");
    close(dynamics.force(ROD), tension(q, v), 1e-14);
}

#[test]
fn a_second_equal_rod_changes_nothing() {
    let mut dynamics = Dynamics::new(&SCENE, &with_rows(&[ROD, TWIN]));
    let (q, v) = state();
    dynamics.value(0.0, &q, &v).expect("consistent");
    close(
        dynamics.force(ROD) + 2.0 * dynamics.force(TWIN),
        tension(q, v),
        1e-13,
    );
    assert!(dynamics.has_dependent_rows());
    assert_eq!(dynamics.acting_rows(), [ROD, TWIN]);
    let least = dynamics.least_norm_of_acting();
    close(least.forces[0], tension(q, v) / 5.0, 1e-13);
    close(least.forces[1], 2.0 * tension(q, v) / 5.0, 1e-13);
    assert!([0, 1].iter().all(|&k| !least.freedom.is_determined(k)));
    dynamics.series(0.0, &q, &v, 12).expect("consistent");
    let one = {
        let mut dynamics = Dynamics::new(&SCENE, &with_rows(&[ROD]));
        dynamics.series(0.0, &q, &v, 12).expect("regular");
        dynamics
    };
    for k in 0..=12 {
        close(
            dynamics.position_series(0)[k],
            one.position_series(0)[k],
            1e-12,
        );
    }
}

#[test]
fn rods_of_different_growth_contradict() {
    let mut dynamics = Dynamics::new(&SCENE, &with_rows(&[ROD, GROWING]));
    let (q, v) = state();
    let error = dynamics.value(0.0, &q, &v).expect_err("two lengths");
    assert!(
        matches!(error, EvaluationError::Inconsistent { row: ROD | GROWING, residual } if residual > 1e-3)
    );
    assert!(["rod", "growing"].contains(&error.item(PENDULUM).expect("named")));
}

#[test]
fn a_constraint_can_replace_inertia() {
    // Only x has inertia: m ẍ = 2 x λ, 0 = −m g + 2 y λ.
    let effects = with_rows(&[ROD]).without(Item::Kinetic(1));
    let mut dynamics = Dynamics::new(&SCENE, &effects);
    let (q, v) = state();
    dynamics.value(0.0, &q, &v).expect("regular together");
    close(
        dynamics.force(ROD),
        SCENE.mass * SCENE.gravity / (2.0 * q[1]),
        1e-14,
    );
    close(
        dynamics.acceleration()[0],
        SCENE.gravity * q[0] / q[1],
        1e-14,
    );
}

#[test]
fn a_coordinate_without_inertia_is_named() {
    let effects = with_rows(&[]).without(Item::Kinetic(1));
    let mut dynamics = Dynamics::new(&SCENE, &effects);
    let (q, v) = state();
    let error = dynamics.value(0.0, &q, &v).expect_err("singular");
    assert_eq!(error, EvaluationError::NoInertia { coordinate: 1 });
    assert_eq!(error.item(PENDULUM), Some("y"));
}

#[test]
fn what_is_not_finite_is_named() {
    let mut dynamics = Dynamics::new(&SCENE, &with_rows(&[ROD]));
    let error = dynamics
        .value(0.0, &[f64::NAN, 0.0], &[0.0; 2])
        .expect_err("not a number");
    assert!(matches!(
        error,
        EvaluationError::NotFiniteAcceleration { .. } | EvaluationError::NotFiniteForce { .. }
    ));
}

#[test]
fn projection_moves_along_the_rod_and_only_when_called_for() {
    for rows in [&[ROD][..], &[ROD, TWIN]] {
        let mut dynamics = Dynamics::new(&SCENE, &with_rows(rows));
        let (mut q, mut v) = ([0.63, -0.81], [1.0, 0.3]);
        assert!(dynamics.project(0.0, &mut q, &mut v, 1e-9).expect("near"));
        // Equal inertia in both directions: the nearest point of the circle is radial.
        let r = 0.63_f64.hypot(0.81);
        close(q[0], 0.63 / r, 1e-15);
        close(q[1], -0.81 / r, 1e-15);
        let radial = (0.63 - 0.3 * 0.81) / r;
        close(v[0], 1.0 - radial * 0.63 / r, 1e-14);
        close(v[1], 0.3 + radial * 0.81 / r, 1e-14);
        assert!(!dynamics.project(0.0, &mut q, &mut v, 1e-12).expect("there"));
    }
}

#[test]
fn projection_keeps_what_is_held() {
    let mut dynamics = Dynamics::new(&SCENE, &with_rows(&[ROD]));
    let (mut q, mut v) = ([0.6, -0.3], [1.0, 0.3]);
    dynamics
        .project_holding(0.0, &mut q, &mut v, &[true, false], &[false, true])
        .expect("possible");
    assert_eq!((q[0], v[1]), (0.6, 0.3));
    close(q[1], -0.8, 1e-15);
    close(v[0], 0.4, 1e-14);
    let failed = dynamics.project_holding(0.0, &mut [1.2, -0.3], &mut v, &[true, false], &[]);
    assert!(matches!(
        failed,
        Err(EvaluationError::Projection { row: ROD, .. })
    ));
}

#[test]
fn projection_follows_a_moving_constraint() {
    let mut dynamics = Dynamics::new(&SCENE, &with_rows(&[GROWING]));
    let (mut q, mut v) = ([0.0, -1.0], [1.0, 0.0]);
    dynamics.project(0.5, &mut q, &mut v, 0.0).expect("near");
    close(q[1], -(1.25_f64.sqrt()), 1e-15);
}

#[test]
fn a_pinned_coordinate_comes_to_rest_exactly() {
    use super::wheel::{Wheel, stuck};
    let mut dynamics = Dynamics::new(&Wheel::<f64>::example(), &Effects::all());
    dynamics.set_mode(&stuck());
    let (mut q, mut v) = ([0.3, 0.2, 1.1, 0.6], [0.55, 0.5, 3e-17, 0.5]);
    assert!(!dynamics.project(0.0, &mut q, &mut v, 1e-12).expect("there"));
    assert_eq!(v, [0.55, 0.5, 0.0, 0.5]);
}
