//! The mass on a rolling wheel: a closed form while stuck, high-precision references beyond.

#![allow(
    clippy::excessive_precision,
    reason = "references are given with all their digits"
)]

use lagrange_core::prelude::*;
use lagrange_problems::scenes::MassOnWheel;
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

#[test]
fn too_much_kinetic_friction_is_a_paradox_and_keeps_the_trajectory() {
    let scene = wheel(0.6, 7.0);
    let failure = Simulation::new(&scene)
        .tolerance(1e-12)
        .run(scene.at(<MassOnWheel>::REST), 0.0..20.0)
        .unwrap_err();
    let Error::NoMode { time, item, .. } = failure.error else {
        panic!("{failure}")
    };
    agree("time of the paradox", time, 2.4617591504319569, 1e-10);
    assert_eq!(item, "grip");
    agree(
        "the trajectory goes up to there",
        failure.trajectory.last_time(),
        time,
        1e-15,
    );
    assert!(failure.trajectory.work().steps > 3);
}
