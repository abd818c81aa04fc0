//! A block on an incline, pushed sideways: friction of two components, whose direction turns.
//!
//! With a = g sin α downhill, n = μ/tan α and ψ the angle of the velocity from downhill, v̇ = a (cos ψ − n) and
//! v ψ̇ = −a sin ψ. In τ = tan ½ψ both time and place are powers: v = c τⁿ⁻¹ (1 + τ²), dt = −v dτ/(a τ).

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, all_agree, closure, event, run, run_by, words};

/// A block on a plane that is inclined by `slope`: x across, y downhill, z off the plane.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * (z * cos(slope) - y * sin(slope)),
    contact(plane: z >= 0),
    friction(grip on plane: slip = (der(x), der(y)), static = mu_static, kinetic = mu_kinetic),
    observe(drag = dot(grip, grip)),
)]
struct Block {
    mass: f64,
    gravity: f64,
    slope: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

const SLOPE: f64 = 0.5;

fn block(ratio: f64) -> Block {
    let mu = ratio * SLOPE.tan();
    Block {
        mass: 2.0,
        gravity: 9.81,
        slope: SLOPE,
        mu_static: mu,
        mu_kinetic: mu,
    }
}

/// ∫ τᵖ⁻¹ dτ between two limits.
fn power(p: f64, low: f64, high: f64) -> f64 {
    if p == 0.0 {
        (high / low).ln()
    } else {
        (high.powf(p) - low.powf(p)) / p
    }
}

/// The way from τ₀ to τ < τ₀, begun with speed v₀: time, x, y.
fn way(ratio: f64, speed: f64, from: f64, to: f64) -> [f64; 3] {
    let (a, n) = (9.81 * SLOPE.sin(), ratio);
    let c = speed / (from.powf(n - 1.0) * (1.0 + from * from));
    let time = c / a * (power(n - 1.0, to, from) + power(n + 1.0, to, from));
    let across =
        2.0 * c * c / a * (power(2.0 * n - 1.0, to, from) + power(2.0 * n + 1.0, to, from));
    let down = c * c / a * (power(2.0 * n - 2.0, to, from) - power(2.0 * n + 2.0, to, from));
    [time, across, down]
}

#[test]
fn a_block_pushed_sideways_comes_to_rest() {
    for ratio in [1.5, 2.0, 3.0, 1.1, 8.0] {
        let speed = 1.7;
        let trajectory = run(&block(ratio), state(&[0.0; 3], &[speed, 0.0, 0.0]), 10.0);
        assert_eq!(words(&trajectory), ["grip sticks"], "{ratio}");
        let rest = event(&trajectory, "grip", "sticks");
        let [time, across, down] = way(ratio, speed, 1.0, 0.0);
        agree("time", rest.time, time, 1e-10);
        all_agree("place", &rest.state.q, &[across, down, 0.0], 1e-10);
        assert_eq!(trajectory.final_state().v, [0.0; 3]);
        assert_eq!(trajectory.final_state().q, rest.state_after.q);
        assert!(closure(&trajectory) < 1e-11, "{}", closure(&trajectory));
        // On the way.
        let mut sampler = trajectory.sampler();
        for tau in [0.8, 0.3, 0.1] {
            let [time, across, down] = way(ratio, speed, 1.0, tau);
            let instant = sampler.at(time).expect("on the way");
            all_agree("on the way", &instant.state.q[..2], &[across, down], 1e-10);
            let limit = block(ratio).mu_kinetic * 2.0 * 9.81 * SLOPE.cos();
            agree("friction", instant.observes[0].sqrt(), limit, 1e-12);
        }
        // Just before it stops the friction points uphill; ψ goes there like a power of the time that is left.
        let limit = block(ratio).mu_kinetic * 2.0 * 9.81 * SLOPE.cos();
        let turned = 1e-8_f64.powf(1.0 / (ratio - 1.0)).max(1e-7);
        let last = [0.0, -limit];
        all_agree("last friction", &rest.forces[1..], &last, 8.0 * turned);
        let before = sampler.at(rest.time * (1.0 - 4e-16));
        let before = before.expect("before it rests");
        all_agree("sampled", &before.forces[1..], &last, 8.0 * turned);
        assert_eq!(trajectory.phases().len(), 2);
    }
}

/// Friction hardly stronger than the slope: long before it stops, its direction follows the slope in a time that is far shorter than its fall. Errors of
/// single steps, however small, must not be all that is left of the slip.
#[test]
fn friction_hardly_stronger_than_the_slope() {
    for ratio in [1.01, 1.001] {
        let speed = 1.3;
        let [time, across, down] = way(ratio, speed, 1.0, 0.0);
        for (method, tolerance) in [
            ("auto", 1e-9),
            ("taylor", 1e-9),
            ("taylor", 1e-12),
            ("radau5", 1e-9),
        ] {
            let start = state(&[0.0; 3], &[speed, 0.0, 0.0]);
            let what = (method, tolerance);
            let trajectory = run_by(&block(ratio), what, start, 1.1 * time);
            assert_eq!(words(&trajectory), ["grip sticks"], "{what:?}");
            let rest = event(&trajectory, "grip", "sticks");
            agree("time", rest.time, time, 1e-6);
            all_agree("place", &rest.state.q, &[across, down, 0.0], 1e-7);
            let steps = trajectory.work().steps;
            assert!(steps < 4000, "{what:?}: {steps} steps");
        }
    }
}

/// Friction as strong as the slope: it never stops, v (1 + cos ψ) = v₀, and ends downhill with half the speed.
#[test]
fn friction_as_strong_as_the_slope() {
    let trajectory = run(&block(1.0), state(&[0.0; 3], &[1.7, 0.0, 0.0]), 5.0);
    assert!(words(&trajectory).is_empty());
    let mut sampler = trajectory.sampler();
    for k in 1..20 {
        let instant = sampler.at(0.25 * f64::from(k)).expect("in the run");
        let (vx, vy) = (instant.state.v[0], instant.state.v[1]);
        agree("v (1 + cos ψ)", vx.hypot(vy) + vy, 1.7, 1e-10);
    }
    agree("end", trajectory.final_state().v[1], 0.85, 1e-9);
}

/// Weaker friction, thrown uphill a little off the line: the slip passes near zero without stopping, the nearer the less off.
#[test]
fn a_slip_passes_near_zero() {
    for off in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let (ratio, speed) = (0.7, 1.3);
        let from = 1.0 / f64::tan(0.5 * off);
        let start = [speed * f64::sin(off), -speed * f64::cos(off), 0.0];
        let [until, across, down] = way(ratio, speed, from, 0.01 * off);
        let trajectory = run(&block(ratio), state(&[0.0; 3], &start), until);
        assert!(words(&trajectory).is_empty());
        let end = trajectory.final_state();
        all_agree("end", &end.q[..2], &[across, down], 1e-9);
        assert!(closure(&trajectory) < 1e-11);
    }
}

/// Thrown straight uphill it stops, or turns back at once, as on a line.
#[test]
fn straight_uphill() {
    for (ratio, kind) in [(0.7, "reverses"), (1.3, "sticks")] {
        let trajectory = run(&block(ratio), state(&[0.0; 3], &[0.0, -2.0, 0.0]), 2.0);
        let a = 9.81 * SLOPE.sin();
        let turn = 2.0 / (a * (1.0 + ratio));
        let event = event(&trajectory, "grip", kind);
        agree("turns", event.time, turn, 1e-12);
        let back = if kind == "sticks" {
            0.0
        } else {
            0.5 * a * (1.0 - ratio) * (2.0 - turn).powi(2)
        };
        agree("place", trajectory.final_state().q[1], back - turn, 1e-11);
        agree("across", trajectory.final_state().q[0], 0.0, 1e-15);
        assert!(closure(&trajectory) < 1e-11);
        let limit = ratio * SLOPE.tan() * 2.0 * 9.81 * SLOPE.cos();
        all_agree("last friction", &event.forces[1..], &[0.0, limit], 1e-12);
    }
}

/// Laid down at rest it stays or begins straight downhill.
#[test]
fn laid_down_at_rest() {
    let trajectory = run(&block(1.01), state(&[0.0; 3], &[0.0; 3]), 3.0);
    assert!(words(&trajectory).is_empty());
    assert_eq!(trajectory.final_state().q, [0.0; 3]);
    let slippery = Block {
        mu_kinetic: 0.4 * SLOPE.tan(),
        ..block(0.9)
    };
    let trajectory = run(&slippery, state(&[0.0; 3], &[0.0; 3]), 3.0);
    let a = 9.81 * SLOPE.sin();
    all_agree(
        "slides",
        &trajectory.final_state().q,
        &[0.0, 0.5 * a * 0.6 * 9.0, 0.0],
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-12);
}

/// Every method follows it to rest.
#[test]
fn all_methods_come_to_rest() {
    let ratio = 2.0;
    let [time, across, down] = way(ratio, 1.7, 1.0, 0.0);
    for (method, tolerance, bound) in [
        ("dopri5", 1e-9, 1e-7),
        ("dop853", 1e-11, 1e-9),
        ("verner98", 1e-11, 1e-9),
        ("radau5", 1e-9, 1e-7),
        ("rk4:1e-3", 1e-9, 1e-7),
        ("gauss6:1e-3", 1e-9, 1e-7),
    ] {
        let scene = block(ratio);
        let start = state(&[0.0; 3], &[1.7, 0.0, 0.0]);
        let trajectory = run_by(&scene, (method, tolerance), start, 3.0);
        assert_eq!(words(&trajectory), ["grip sticks"], "{method}");
        agree(
            method,
            event(&trajectory, "grip", "sticks").time,
            time,
            bound,
        );
        all_agree(
            method,
            &trajectory.final_state().q,
            &[across, down, 0.0],
            bound,
        );
    }
}

/// Errors of the direction, as large as the tolerance, must not hold up a slip that friction hardly ends.
#[test]
fn friction_that_is_hardly_enough_ends_the_slip_by_all_methods() {
    let (ratio, speed) = (1.0003, 0.3);
    let [time, ..] = way(ratio, speed, 1.0, 0.0);
    for method in ["auto", "dop853", "verner98", "dopri5"] {
        let start = state(&[0.0; 3], &[speed, 0.0, 0.0]);
        let trajectory = run_by(&block(ratio), (method, 1e-9), start, 1.1 * time);
        assert_eq!(words(&trajectory), ["grip sticks"], "{method}");
        let rest = event(&trajectory, "grip", "sticks");
        agree(method, rest.time, time, 1e-6);
    }
}
