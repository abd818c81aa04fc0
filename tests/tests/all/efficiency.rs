//! What the methods cost on constrained systems: counted work, pinned, and how the error falls with it.

use expect_test::{Expect, expect};
use lagrange_core::prelude::*;
use lagrange_problems::scenes::{CartesianPendulum, MassOnWheel};
use lagrange_tests::{first_start, run_by};
use std::fmt::Write;

const METHODS: [&str; 7] = [
    "taylor",
    "dop853",
    "dopri5",
    "verner98",
    "radau5",
    "rk4:0.005",
    "gauss6:0.01",
];

/// Work of every method from a scene's first start; `UPDATE_EXPECT=1 cargo test` accepts what has become better.
fn check<S: Derived<Scalar = f64> + Default>(until: f64, tolerance: f64, expected: &Expect) {
    let scene = S::default();
    let mut table = String::from(
        "method        steps  rejected  evaluations  series  factorizations  projections\n",
    );
    for name in METHODS {
        let run = run_by(&scene, (name, tolerance), first_start(&scene), until);
        let w = run.work();
        writeln!(
            table,
            "{name:<12}{:>7}{:>10}{:>13}{:>8}{:>16}{:>13}",
            w.steps, w.rejected, w.evaluations, w.series, w.factorizations, w.projections
        )
        .expect("a string");
    }
    expected.assert_eq(&table);
}

#[test]
fn work_on_the_wheel_does_not_grow() {
    check::<MassOnWheel>(
        10.0,
        1e-9,
        &expect![[r#"
            method        steps  rejected  evaluations  series  factorizations  projections
            taylor            9         0           16      10               0            0
            dop853           22         2          619       4               0            0
            dopri5           96         0         1551       4               0            0
            verner98         17         0          544       4               0            0
            radau5          281         0         4932       4               9            0
            rk4:0.005       603         0         9658       4               0            0
            gauss6:0.01     303         0         7324       4               0            0
        "#]],
    );
}

#[test]
fn work_on_the_cartesian_pendulum_does_not_grow() {
    check::<CartesianPendulum>(
        10.0,
        1e-9,
        &expect![[r#"
            method        steps  rejected  evaluations  series  factorizations  projections
            taylor           61         0           62      61               0           53
            dop853          167         6         3359       3             150          117
            dopri5          765         0         8221      12             500          568
            verner98        119         0         2901       2              18           42
            radau5         3077         0        27910       1             207            2
            rk4:0.005      2000         0        13885       1             262         1884
            gauss6:0.01    1000         0        17036       1               0            0
        "#]],
    );
}

/// Steps, and the error of the Cartesian pendulum that goes over the top, after 2 s, by Jacobi's elliptic functions.
fn pendulum(method: &str, tolerance: f64) -> (f64, f64) {
    let scene = CartesianPendulum::default();
    let start = scene.at(<CartesianPendulum>::KICKED);
    let exact = scene.closed_form(&start, 2.0).expect("a pendulum");
    let run = run_by(&scene, (method, tolerance), start, 2.0);
    let end = run.final_state();
    let found = end.q.iter().chain(&end.v);
    let pairs = found.zip(exact.state.q.iter().chain(&exact.state.v));
    let errors = pairs.map(|(x, exact)| (x - exact).abs());
    (run.work().steps as f64, errors.fold(0.0, f64::max))
}

/// Doubling the steps divides the error by 2^order, projections onto the rod included.
#[track_caller]
fn check_order(coarse: (&str, f64), fine: (&str, f64), order: f64) {
    let (few, large) = pendulum(coarse.0, coarse.1);
    let (many, small) = pendulum(fine.0, fine.1);
    let slope = (large / small).ln() / (many / few).ln();
    assert!(
        (order - 0.5..order + 1.0).contains(&slope),
        "slope {slope:.2}, not {order}: error {large:.1e} in {few} steps, {small:.1e} in {many}"
    );
}

#[test]
fn dormand_prince_853_keeps_its_order_on_constraints() {
    check_order(("dop853", 1e-8), ("dop853", 1e-11), 8.0);
}

#[test]
fn dormand_prince_54_keeps_its_order_on_constraints() {
    check_order(("dopri5", 1e-8), ("dopri5", 1e-11), 5.0);
}

#[test]
fn verner_98_keeps_its_order_on_constraints() {
    check_order(("verner98", 1e-8), ("verner98", 1e-11), 9.0);
}

#[test]
fn radau_5_follows_the_tolerance_on_constraints() {
    // Its iterations end a fixed share below the tolerance, so that errors fall with it and not with the fifth power.
    let (_, large) = pendulum("radau5", 1e-7);
    let (_, small) = pendulum("radau5", 1e-9);
    assert!(small < 0.02 * large, "{large:.1e}, {small:.1e}");
    assert!(small < 1e-9, "{small:.1e}");
}

#[test]
fn runge_kutta_4_keeps_its_order_on_constraints() {
    check_order(("rk4:0.01", 1e-12), ("rk4:0.002", 1e-12), 4.0);
}

#[test]
fn gauss_6_keeps_its_order_on_constraints() {
    check_order(("gauss6:0.1", 1e-12), ("gauss6:0.05", 1e-12), 6.0);
}

#[test]
fn the_taylor_method_follows_the_tolerance_on_constraints() {
    // Its order grows with the tolerance's digits: three more of these divide the error by a thousand, in hardly more steps.
    let (few, large) = pendulum("taylor", 1e-6);
    let (many, small) = pendulum("taylor", 1e-9);
    assert!(small < 1e-2 * large, "{large:.1e}, {small:.1e}");
    assert!(many < 1.2 * few, "{few} steps, then {many}");
}

/// Energy after `periods` periods of a swing from 1 rad, in units of 2⁻⁵³ √steps; and the largest miss of the rod.
fn long_swing(scene: &CartesianPendulum, periods: usize) -> (f64, f64) {
    let (l, g, angle) = (scene.length, scene.gravity, 1.0f64);
    let period =
        core::f64::consts::TAU * (l / g).sqrt() / lagrange_tests::agm(1.0, (0.5 * angle).cos());
    let mut state = State::new(vec![l * angle.sin(), -l * angle.cos()], vec![0.0; 2]);
    let energy = |s: &State<f64>| 0.5 * (s.v[0].powi(2) + s.v[1].powi(2)) / (g * l) + s.q[1] / l;
    let before = energy(&state);
    let simulation = Simulation::new(scene).tolerance(1e-16);
    let (mut steps, mut miss) = (0, 0.0f64);
    for _ in 0..periods / 100 {
        let run = simulation
            .run(state, 0.0..100.0 * period)
            .unwrap_or_else(|failure| panic!("{failure}"));
        steps += run.work().steps;
        state = run.final_state().clone();
        let [x, y] = [state.q[0] / l, state.q[1] / l];
        miss = miss.max((x * x + y * y - 1.0).abs());
    }
    let drift = (energy(&state) - before).abs();
    (drift / (0.5 * f64::EPSILON * (steps as f64).sqrt()), miss)
}

#[test]
fn rounding_does_not_add_up_over_a_thousand_periods() {
    // A force that always errs to the same side would show as tens to hundreds of units.
    for length in [1.0, 1.41, 0.9] {
        let scene = CartesianPendulum {
            length,
            ..CartesianPendulum::default()
        };
        let (drift, miss) = long_swing(&scene, 2000);
        assert!(drift < 10.0, "length {length}: {drift:.1} units");
        assert!(
            miss < 4e-15,
            "length {length}: the rod misses by {miss:.1e}"
        );
    }
}
