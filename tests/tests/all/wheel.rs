//! The mass on a rolling wheel: a closed form while stuck, high-precision references beyond.

#![allow(
    clippy::excessive_precision,
    reason = "references are given with all their digits"
)]

use lagrange_core::prelude::*;
use lagrange_problems::scenes::MassOnWheel;
use lagrange_tests::extrapolate;
use lagrange_tests::{agree, closure, event, integral, root, run, words};

fn wheel(mu_static: f64, mu_kinetic: f64) -> MassOnWheel {
    MassOnWheel {
        mu_static,
        mu_kinetic,
        ..MassOnWheel::default()
    }
}

/// θ̇² while stuck, d after the start, from the energy: T = ½ θ̇² (I + (M + 2m) R² + 2 m R² cos θ), V = m g R cos θ.
fn stuck_speed_squared(w: &MassOnWheel, d: f64) -> f64 {
    let th = w.start_angle + d;
    let total = w.inertia
        + (w.wheel + 2.0 * w.mass) * w.radius.powi(2)
        + 2.0 * w.mass * w.radius.powi(2) * th.cos();
    // cos θ₀ − cos θ without cancellation.
    let fall = 2.0 * (w.start_angle + 0.5 * d).sin() * (0.5 * d).sin();
    2.0 * w.mass * w.gravity * w.radius * fall / total
}

/// (N, F) while stuck, by Newton's law for the mass.
fn stuck_forces(w: &MassOnWheel, th: f64) -> (f64, f64) {
    let (s, c) = th.sin_cos();
    let (m, r, g) = (w.mass, w.radius, w.gravity);
    let w2 = stuck_speed_squared(w, th - w.start_angle);
    let total = w.inertia + (w.wheel + 2.0 * m) * r * r + 2.0 * m * r * r * c;
    let angular = (m * g * r * s + m * r * r * s * w2) / total;
    let (ax, ay) = (
        r * angular + r * (angular * c - w2 * s),
        -r * (angular * s + w2 * c),
    );
    let (fx, fy) = (m * ax, m * (ay + g));
    (fx * s + fy * c, fx * c - fy * s)
}

#[test]
fn the_default_run_meets_the_references() {
    let scene = wheel(0.6, 0.5);
    let trajectory = run(&scene, scene.at(<MassOnWheel>::REST), 20.0);
    assert_eq!(words(&trajectory), ["grip slips", "rim lost", "floor stop"]);
    // Stuck phase by closed form and quadrature, slipping by a Taylor method with 40 digits (mpmath), flight exact.
    let slips = event(&trajectory, "grip", "slips");
    agree("θ slip", slips.state.q[3], 0.62385036883440965, 1e-10);
    agree("t slip", slips.time, 2.4617591504319569, 1e-10);
    agree("ω slip", slips.state.v[3], 0.81246112272838735, 1e-10);
    agree("N slip", slips.forces[1], 1.5886358434764157, 1e-10);
    agree("F slip", slips.forces[2], -0.95318150608584942, 1e-10);
    let lost = event(&trajectory, "rim", "lost");
    agree("θ leave", lost.state.q[3], 1.0675317796129887, 1e-10);
    agree("t leave", lost.time, 2.7321157712865963, 1e-10);
    agree("ω leave", lost.state.v[3], 3.0761157931132559, 1e-10);
    agree("φ leave", lost.state.q[1], 0.80819444866167682, 1e-10);
    agree("φ̇ leave", lost.state.v[1], 0.88531027637121046, 1e-10);
    agree("t end", trajectory.last_time(), 3.0070365979502416, 1e-10);
    let end = trajectory.final_state();
    let (s, c) = end.q[3].sin_cos();
    agree(
        "x of the mass",
        end.q[0] + end.q[2] * s,
        1.1677313428728725,
        1e-10,
    );
    agree("x of the wheel", end.q[0], 0.52579234084773512, 1e-10);
    agree(
        "ẋ of the mass",
        end.v[0] + end.v[2] * s + end.q[2] * c * end.v[3],
        1.1844418335278810,
        1e-10,
    );
    agree(
        "ẏ of the mass",
        end.v[2] * c - end.q[2] * s * end.v[3],
        -4.0443316849751310,
        1e-10,
    );
    assert!(closure(&trajectory) < 1e-10);
}

#[test]
fn slip_begins_where_the_energy_integral_says() {
    for (mu, start_angle, mass, radius) in [
        (0.6, 0.05, 0.2, 0.5),
        (0.3, 0.2, 0.5, 0.7),
        (1.0, 0.4, 1.0, 0.3),
        (0.8, 0.01, 0.05, 1.2),
    ] {
        let scene = MassOnWheel {
            start_angle,
            mass,
            radius,
            inertia: 0.5 * radius * radius,
            ..wheel(mu, 0.8 * mu)
        };
        let angle = root(
            |th| mu * stuck_forces(&scene, th).0 - stuck_forces(&scene, th).1.abs(),
            start_angle,
            1.5,
        );
        let time = integral(
            |d| stuck_speed_squared(&scene, d).sqrt().recip(),
            start_angle,
            angle,
        );
        let trajectory = run(&scene, scene.at(<MassOnWheel>::REST), 20.0);
        let slips = event(&trajectory, "grip", "slips");
        agree("θ slip", slips.state.q[3], angle, 1e-10);
        agree("t slip", slips.time, time, 1e-10);
        assert!(closure(&trajectory) < 1e-10);
    }
}

/// d(θ̇², t, ẋ, x)/dθ while the mass slips forward over the rim: with k = sin θ − μ (1 + cos θ) and Λ = W + I/R²,
/// Λ ẍ = −N k and N (1 + m k sin θ / Λ) = m g cos θ − m R θ̇².
fn slipping(w: &MassOnWheel, th: f64, y: &[f64; 4]) -> [f64; 4] {
    let (s, c) = th.sin_cos();
    let k = s - w.mu_kinetic * (1.0 + c);
    let lambda = w.wheel + w.inertia / (w.radius * w.radius);
    let normal = w.mass * (w.gravity * c - w.radius * y[0]) / (1.0 + w.mass * k * s / lambda);
    let wheel = -normal * k / lambda;
    let angular = (w.gravity * s - w.mu_kinetic * normal / w.mass - wheel * c) / w.radius;
    let rate = y[0].sqrt();
    [2.0 * angular, 1.0 / rate, wheel / rate, y[2] / rate]
}

#[test]
fn slipping_agrees_with_its_reduced_equation_integrated_apart() {
    for (mu_static, mu_kinetic, start_angle, mass, radius, gravity) in [
        (0.6, 0.5, 0.05, 0.2, 0.5, 9.81),
        (0.6, 0.1, 0.3, 0.2, 0.5, 9.81),
        (0.4, 0.3, 0.2, 1.5, 0.7, 3.7),
        (0.9, 0.6, 0.6, 0.5, 2.0, 9.81),
        (1.5, 0.4, 0.9, 0.1, 0.1, 25.0),
        (1.2, 1.2, 0.01, 0.3, 0.5, 9.81),
    ] {
        let scene = MassOnWheel {
            start_angle,
            mass,
            radius,
            gravity,
            inertia: 0.5 * radius * radius,
            ..wheel(mu_static, mu_kinetic)
        };
        let onset = root(
            |th| mu_static * stuck_forces(&scene, th).0 - stuck_forces(&scene, th).1.abs(),
            start_angle,
            1.5,
        );
        let u = stuck_speed_squared(&scene, onset - start_angle);
        let time = integral(
            |d| stuck_speed_squared(&scene, d).sqrt().recip(),
            start_angle,
            onset,
        );
        let turn = onset - start_angle;
        let from = [u, time, radius * u.sqrt(), radius * turn];
        let slide = |th: f64| extrapolate(|th, y| slipping(&scene, th, y), onset, th, from, 16);
        let leave = root(|th| gravity * th.cos() - radius * slide(th)[0], onset, 1.57);
        let [u, time, speed, place] = slide(leave);

        let trajectory = run(&scene, scene.at(<MassOnWheel>::REST), 100.0);
        assert_eq!(words(&trajectory)[..2], ["grip slips", "rim lost"]);
        let lost = event(&trajectory, "rim", "lost");
        let what = |name: &str| format!("{name} for {scene:?}");
        agree(what("θ leave"), lost.state.q[3], leave, 1e-10);
        agree(what("t leave"), lost.time, time, 1e-10);
        agree(what("ω leave"), lost.state.v[3], u.sqrt(), 1e-10);
        agree(what("ẋ leave"), lost.state.v[0], speed, 1e-10);
        agree(what("x leave"), lost.state.q[0], place, 1e-10);
        agree(what("φ leave"), lost.state.q[1], place / radius, 1e-10);
        assert!(closure(&trajectory) < 1e-10);
        // After that the wheel rolls on as it is.
        let now = trajectory.sampler().at(lost.time + 1e-2).expect("flight");
        agree("ẋ in flight", now.state.v[0], speed, 1e-10);
        agree("rolling multiplier in flight", now.forces[0], 0.0, 1e-12);
    }
}

/// The mass in the frame of the floor: place and velocity.
fn mass(state: &State<f64>) -> [f64; 4] {
    let (s, c) = state.q[3].sin_cos();
    let (r, [vx, _, vr, w]) = (state.q[2], [state.v[0], 0.0, state.v[2], state.v[3]]);
    [
        state.q[0] + r * s,
        r * c,
        vx + vr * s + r * w * c,
        vr * c - r * w * s,
    ]
}

#[test]
fn a_mass_that_is_too_fast_flies_a_parabola_until_it_meets_the_floor() {
    let scene = wheel(0.6, 0.5);
    for turn in [5.0, 8.0, -6.0] {
        let start = State::new(vec![0.0, 0.0, 0.5, 0.3], vec![0.5 * turn, turn, 0.0, turn]);
        let trajectory = run(&scene, start.clone(), 100.0);
        assert_eq!(words(&trajectory), ["rim lost", "floor stop"]);
        assert_eq!(trajectory.events()[0].time, 0.0);
        let ([x, y, vx, vy], t) = (mass(&start), trajectory.last_time());
        let fall = (vy + (vy * vy + 2.0 * 9.81 * (y + 0.5)).sqrt()) / 9.81;
        agree("time", t, fall, 1e-12);
        let end = mass(trajectory.final_state());
        agree("x", end[0], x + vx * t, 1e-11);
        agree("y", end[1], -0.5, 1e-12);
        agree("ẋ", end[2], vx, 1e-11);
        agree("ẏ", end[3], vy - 9.81 * t, 1e-11);
        agree(
            "the wheel",
            trajectory.final_state().q[0],
            0.5 * turn * t,
            1e-12,
        );
    }
}

#[test]
fn strong_static_friction_goes_from_stick_to_flight_in_one_event() {
    let scene = wheel(10.0, 0.5);
    let trajectory = run(&scene, scene.at(<MassOnWheel>::REST), 20.0);
    assert_eq!(words(&trajectory), ["rim lost", "floor stop"]);
    let lost = event(&trajectory, "rim", "lost");
    let angle = root(
        |th| 10.0 * stuck_forces(&scene, th).0 - stuck_forces(&scene, th).1.abs(),
        0.1,
        1.5,
    );
    agree("θ", lost.state.q[3], angle, 1e-10);
    assert_eq!(lost.after.frictions, [FrictionMode::Inactive]);
}
