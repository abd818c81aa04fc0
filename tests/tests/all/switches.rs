//! Where and when modes end: closed forms of the sphere and shell scenes, over parameters and starts.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;
use lagrange_tests::{agree, closure, event, integral, root, run, words};

const TOLERANCE: f64 = 1e-10;

/// cos θ₀ − cos(θ₀ + d) without cancellation.
fn fall(start: f64, d: f64) -> f64 {
    2.0 * (start + 0.5 * d).sin() * (0.5 * d).sin()
}

/// Checks that the flight after `lost` is a parabola to the end of the run, and ends at height `floor`.
fn is_parabola(trajectory: &Trajectory, lost: f64, gravity: f64, floor: f64) {
    let place = |state: &State<f64>| {
        let ((r, th), (vr, w)) = ((state.q[0], state.q[1]), (state.v[0], state.v[1]));
        let (s, c) = th.sin_cos();
        [r * s, r * c, vr * s + r * w * c, vr * c - r * w * s]
    };
    let event = trajectory
        .events()
        .iter()
        .find(|e| e.time == lost)
        .expect("an event at take-off");
    let from = place(&event.state_after);
    let end = place(trajectory.final_state());
    let t = trajectory.last_time() - lost;
    agree("x", end[0], from[0] + from[2] * t, TOLERANCE);
    agree(
        "y",
        end[1],
        from[1] + from[3] * t - 0.5 * gravity * t * t,
        TOLERANCE,
    );
    agree("ẋ", end[2], from[2], TOLERANCE);
    agree("ẏ", end[3], from[3] - gravity * t, TOLERANCE);
    agree("height at the end", end[1], floor, TOLERANCE);
}

#[test]
fn a_sliding_mass_leaves_at_two_thirds() {
    for (start_angle, radius, gravity, mass) in [
        (0.01, 1.0, 9.81, 1.0),
        (0.001, 2.5, 1.62, 3.0),
        (0.3, 0.1, 9.81, 0.2),
        (0.6, 10.0, 25.0, 1.0),
        (0.9, 1.0, 9.81, 7.0),
    ] {
        let scene = MassOnShell {
            mass,
            radius,
            gravity,
            start_angle,
        };
        let trajectory = run(&scene, scene.at(<MassOnShell>::REST), 100.0);
        assert_eq!(words(&trajectory), ["shell lost", "floor stop"]);
        let lost = event(&trajectory, "shell", "lost");
        let angle = (2.0 / 3.0 * start_angle.cos()).acos();
        agree("angle", lost.state.q[1], angle, TOLERANCE);
        let speed = |d: f64| (2.0 * gravity / radius * fall(start_angle, d)).sqrt();
        agree(
            "time",
            lost.time,
            integral(|d| speed(d).recip(), start_angle, angle),
            TOLERANCE,
        );
        is_parabola(&trajectory, lost.time, gravity, -radius);
        assert!(closure(&trajectory) < TOLERANCE);
    }
}

#[test]
fn a_rolling_sphere_leaves_at_ten_seventeenths() {
    for (start_angle, radius, sphere_radius, gravity) in [
        (0.01, 1.0, 0.2, 9.81),
        (0.2, 0.3, 0.5, 3.7),
        (0.5, 5.0, 0.1, 9.81),
        (0.9, 1.0, 1.0, 9.81),
    ] {
        let scene = RollingSphere {
            mass: 0.7,
            radius,
            sphere_radius,
            gravity,
            start_angle,
        };
        let trajectory = run(&scene, scene.at(<RollingSphere>::REST), 100.0);
        assert_eq!(words(&trajectory), ["shell lost", "floor stop"]);
        let lost = event(&trajectory, "shell", "lost");
        let angle = (10.0 / 17.0 * start_angle.cos()).acos();
        agree("angle", lost.state.q[1], angle, TOLERANCE);
        let c = radius + sphere_radius;
        let speed = |d: f64| (10.0 / 7.0 * gravity / c * fall(start_angle, d)).sqrt();
        agree(
            "time",
            lost.time,
            integral(|d| speed(d).recip(), start_angle, angle),
            TOLERANCE,
        );
        agree(
            "turn",
            lost.state.q[2],
            c / sphere_radius * (angle - start_angle),
            TOLERANCE,
        );
        is_parabola(&trajectory, lost.time, gravity, -radius);
        assert!(closure(&trajectory) < TOLERANCE);
    }
}

/// u = θ̇² while slipping: du/dθ − 2μ u = 2g/c (sin θ − μ cos θ), u(θ₁) = u₁; the particular solution is
/// A sin θ + B cos θ with A = −6μ k, B = (4μ² − 2) k, k = g/(c(1 + 4μ²)).
fn slipping(mu: f64, gravity: f64, c: f64, from: (f64, f64), angle: f64) -> f64 {
    let k = gravity / (c * (1.0 + 4.0 * mu * mu));
    let particular = |th: f64| k * (-6.0 * mu * th.sin() + (4.0 * mu * mu - 2.0) * th.cos());
    particular(angle) + (from.1 - particular(from.0)) * (2.0 * mu * (angle - from.0)).exp()
}

#[test]
fn a_sphere_rolls_slips_and_leaves() {
    for (start_angle, mu_static, mu_kinetic, radius) in [
        (0.01, 0.4, 0.3, 1.0),
        (0.01, 1.0, 1.0, 1.0),
        (0.3, 0.6, 0.1, 2.0),
        (0.05, 0.2, 0.2, 0.5),
        (0.01, 100.0, 100.0, 1.0),
        (0.9, 3.0, 0.5, 1.0),
    ] {
        let scene = RollingSlippingSphere {
            mu_static,
            mu_kinetic,
            radius,
            start_angle,
            ..RollingSlippingSphere::default()
        };
        let (g, c) = (scene.gravity, radius + scene.sphere_radius);
        let trajectory = run(&scene, scene.at(<RollingSlippingSphere>::REST), 100.0);
        assert_eq!(
            words(&trajectory),
            ["grip slips", "shell lost", "floor stop"],
            "μ = {mu_static}, {mu_kinetic}"
        );
        let demand =
            |th: f64| mu_static * (17.0 * th.cos() - 10.0 * start_angle.cos()) - 2.0 * th.sin();
        let onset = root(
            demand,
            start_angle,
            (10.0 / 17.0 * start_angle.cos()).acos(),
        );
        let slips = event(&trajectory, "grip", "slips");
        agree("onset", slips.state.q[1], onset, TOLERANCE);
        let rolling = |d: f64| (10.0 / 7.0 * g / c * fall(start_angle, d)).sqrt();
        let time = integral(|d| rolling(d).recip(), start_angle, onset);
        agree("time of onset", slips.time, time, TOLERANCE);
        let from = (onset, rolling(onset - start_angle).powi(2));
        let leave = root(
            |th| g * th.cos() - c * slipping(mu_kinetic, g, c, from, th),
            onset,
            1.57,
        );
        let lost = event(&trajectory, "shell", "lost");
        agree("leave", lost.state.q[1], leave, TOLERANCE);
        let slide = integral(
            |d| slipping(mu_kinetic, g, c, from, onset + d).sqrt().recip(),
            onset,
            leave,
        );
        agree("time of leaving", lost.time, time + slide, TOLERANCE);
        is_parabola(&trajectory, lost.time, g, -radius);
        assert!(closure(&trajectory) < TOLERANCE);
    }
}

#[test]
fn with_little_friction_it_slips_from_the_start() {
    let scene = RollingSlippingSphere {
        mu_static: 0.02,
        mu_kinetic: 0.01,
        start_angle: 0.3,
        ..RollingSlippingSphere::default()
    };
    let trajectory = run(&scene, scene.at(<RollingSlippingSphere>::REST), 100.0);
    assert_eq!(
        words(&trajectory),
        ["grip slips", "shell lost", "floor stop"]
    );
    assert_eq!(trajectory.events()[0].time, 0.0);
    let (g, c) = (scene.gravity, 1.2);
    let leave = root(
        |th| g * th.cos() - c * slipping(0.01, g, c, (0.3, 0.0), th),
        0.31,
        1.57,
    );
    agree(
        "leave",
        event(&trajectory, "shell", "lost").state.q[1],
        leave,
        TOLERANCE,
    );
}

#[test]
fn too_fast_it_leaves_at_once() {
    let scene = RollingSlippingSphere::default();
    let start = State::new(vec![1.2, 0.2, 0.0], vec![0.0, 5.0, 30.0]);
    let trajectory = run(&scene, start, 100.0);
    assert_eq!(words(&trajectory), ["shell lost", "floor stop"]);
    assert_eq!(trajectory.events()[0].time, 0.0);
    is_parabola(&trajectory, 0.0, scene.gravity, -1.0);
}

#[test]
fn in_the_bowl_large_friction_never_slips_and_small_swings_have_their_period() {
    let scene = SphereInBowl {
        mu_static: 1e6,
        mu_kinetic: 1e6,
        ..SphereInBowl::default()
    };
    let trajectory = run(&scene, scene.at(<SphereInBowl>::REST), 20.0);
    assert!(trajectory.events().is_empty(), "{:?}", words(&trajectory));
    // θ̇² = (10/7) g/(R − a) (cos θ − cos θ₀) all along.
    let mut sampler = trajectory.sampler();
    for k in 0..50 {
        let instant = sampler.at(0.4 * f64::from(k)).expect("inside");
        let energy = 10.0 / 7.0 * 9.81 / 0.8 * (instant.state.q[1].cos() - scene.start_angle.cos());
        agree("θ̇²", instant.state.v[1].powi(2), energy, TOLERANCE);
        let normal =
            (17.0 * instant.state.q[1].cos() - 10.0 * scene.start_angle.cos()) * 9.81 / 7.0;
        agree("N", instant.forces[0], normal, TOLERANCE);
    }
    // Small swings: ω² = (5/7) g/(R − a), period corrected by θ₀²/16.
    let small = SphereInBowl {
        start_angle: 1e-3,
        ..scene
    };
    let quarter =
        0.5 * core::f64::consts::PI / (5.0 / 7.0 * 9.81_f64 / 0.8).sqrt() * (1.0 + 1e-6 / 16.0);
    let trajectory = run(&small, small.at(<SphereInBowl>::REST), quarter);
    assert!(trajectory.final_state().q[1].abs() < 1e-14);
}

#[test]
fn in_the_bowl_it_goes_round_or_falls_off() {
    let limit = (27.0 / 7.0 * 9.81_f64 * 0.8).sqrt();
    for (share, goes_round) in [(1.001, true), (0.999, false), (0.8, false)] {
        let scene = SphereInBowl {
            mu_static: 1e10,
            mu_kinetic: 1e10,
            start_speed: share * limit,
            ..SphereInBowl::default()
        };
        let start = scene.at(<SphereInBowl>::KICKED);
        let trajectory = run(&scene, start, 3.0);
        if goes_round {
            assert!(trajectory.events().is_empty(), "{:?}", words(&trajectory));
            assert!(trajectory.final_state().q[1] > 2.0 * core::f64::consts::PI);
        } else {
            // It slips only where N is some 1e-10 of its weight. N = 0 at cos θ = (10/17)(1 − (7/10) v₀²/(g c)), above the height of the centre.
            let lost = event(&trajectory, "bowl", "lost");
            let v2 = (share * limit).powi(2);
            let cosine = 10.0 / 17.0 * (1.0 - 0.7 * v2 / (9.81 * 0.8));
            agree("cos θ", lost.state.q[1].cos(), cosine, TOLERANCE);
            assert!(cosine < 0.0);
        }
    }
}
