//! The sphere in the bowl from rest and kicked: rolling, slipping, falling off and landing, all in closed form.
//!
//! θ from the bottom, ρ = R − a, u = θ̇², slip s = ρ θ̇ + a φ̇. Rolling: u = u₁ + (10/7)(g/ρ)(cos θ − cos θ₁), which needs
//! F = (2/7) m g sin θ. Down from rest on the right, and up on the right after a kick, it slips backward (s < 0): F = +μ N.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::SphereInBowl;
use lagrange_tests::{agm, agree, closure, event, integral, root, run, words};

/// u(θ) while slipping backward (s < 0, F = +μ N): du/dθ = −(2g/ρ) sin θ + 2μ (u + (g/ρ) cos θ), whichever way it moves.
/// Particular solution (g/ρ)/(1 + 4μ²) · ((2 − 4μ²) cos θ + 6μ sin θ).
fn slipping(mu: f64, g_over_rho: f64, from: (f64, f64), theta: f64) -> f64 {
    let factor = g_over_rho / (1.0 + 4.0 * mu * mu);
    let particular = |th: f64| factor * ((2.0 - 4.0 * mu * mu) * th.cos() + 6.0 * mu * th.sin());
    particular(theta) + (from.1 - particular(from.0)) * (2.0 * mu * (theta - from.0)).exp()
}

#[test]
fn from_rest_it_slips_then_rolls_then_slips_the_other_way() {
    for (start_angle, mu_static, mu_kinetic, radius, gravity) in [
        (1.2, 0.4, 0.3, 1.0, 9.81),
        (1.5, 0.5, 0.4, 2.0, 9.81),
        (0.9, 0.3, 0.25, 0.7, 3.7),
        (0.6, 0.13, 0.1, 1.0, 25.0),
    ] {
        let scene = SphereInBowl {
            start_angle,
            mu_static,
            mu_kinetic,
            radius,
            gravity,
            ..SphereInBowl::default()
        };
        let rho = radius - scene.sphere_radius;
        let k = gravity / rho;
        let trajectory = run(&scene, scene.at(<SphereInBowl>::REST), 20.0);
        let told = words(&trajectory);
        assert_eq!(
            told[..3],
            ["grip slips", "grip sticks", "grip slips"],
            "{scene:?}"
        );
        assert_eq!(trajectory.events()[0].time, 0.0);

        // Down: θ = θ₀ − d; near d = 0, u ∝ d. The speed of the surface a φ̇ grows by (5/2) μ N/m.
        let u = |d: f64| slipping(mu_kinetic, k, (start_angle, 0.0), start_angle - d);
        let slowly = 1e-4; // Below this the closed form cancels; its Taylor series there is exact enough.
        let u = |d: f64| {
            if d > slowly {
                u(d)
            } else {
                taylor(mu_kinetic, k, start_angle, d)
            }
        };
        let surface = |d: f64| {
            integral(
                |e| {
                    let u = u(e);
                    2.5 * mu_kinetic * (rho * u + gravity * (start_angle - e).cos()) / u.sqrt()
                },
                0.0,
                d,
            )
        };
        let fallen = root(|d| surface(d) - rho * u(d).sqrt(), 0.05, start_angle + 0.3);
        let time = integral(|d| u(d).sqrt().recip(), 0.0, fallen);
        let sticks = event(&trajectory, "grip", "sticks");
        let theta = start_angle - fallen;
        agree("θ of sticking", sticks.state.q[1], theta, 1e-10);
        agree("time of sticking", sticks.time, time, 1e-10);
        agree("a φ̇", 0.2 * sticks.state.v[2], surface(fallen), 1e-10);

        // Rolling on through the bottom until friction is not enough on the other side.
        let u1 = u(fallen);
        let rolling = |th: f64| u1 + 10.0 / 7.0 * k * (th.cos() - theta.cos());
        let onset = root(
            |th| {
                let normal = rho * rolling(th) + gravity * th.cos();
                mu_static * normal - 2.0 / 7.0 * gravity * th.sin().abs()
            },
            -start_angle,
            0.0,
        );
        let rest = integral(|d| rolling(theta - d).sqrt().recip(), 0.0, theta - onset);
        let slips = &trajectory.events()[2];
        agree("θ of the second slip", slips.state.q[1], onset, 1e-10);
        agree("time of the second slip", slips.time, time + rest, 1e-10);
        assert!(closure(&trajectory) < 1e-10);
    }
}

/// u(θ₀ − d) from rest by its Taylor series in d: u = −u₁ d + u₂ d²/2 − …, with derivatives from the differential equation.
fn taylor(mu: f64, k: f64, theta: f64, d: f64) -> f64 {
    let (s, c) = theta.sin_cos();
    // f = −2k sin θ + 2μk cos θ and its derivatives.
    let f = [
        -2.0 * k * s + 2.0 * mu * k * c,
        -2.0 * k * c - 2.0 * mu * k * s,
        2.0 * k * s - 2.0 * mu * k * c,
        2.0 * k * c + 2.0 * mu * k * s,
    ];
    let mut derivative = 0.0;
    let (mut sum, mut factor) = (0.0, 1.0);
    for (n, f) in f.into_iter().enumerate() {
        derivative = 2.0 * mu * derivative + f;
        factor *= -d / (n + 1) as f64;
        sum += derivative * factor;
    }
    sum
}

#[test]
fn large_friction_swings_with_the_period_of_a_pendulum() {
    for start_angle in [0.01_f64, 0.5, 1.2, 1.5] {
        let scene = SphereInBowl {
            start_angle,
            mu_static: 1e9,
            mu_kinetic: 1e9,
            ..SphereInBowl::default()
        };
        let omega = (5.0 / 7.0 * 9.81_f64 / 0.8).sqrt();
        let period = 2.0 * core::f64::consts::PI / (omega * agm(1.0, (0.5 * start_angle).cos()));
        let trajectory = run(&scene, scene.at(<SphereInBowl>::REST), 10.0 * period);
        assert!(trajectory.events().is_empty(), "{:?}", words(&trajectory));
        for k in 0..=20 {
            let time = (0.5 * period * f64::from(k)).min(trajectory.last_time());
            let now = trajectory.sampler().at(time).expect("inside");
            let side = if k % 2 == 0 { 1.0 } else { -1.0 };
            agree("θ", now.state.q[1], side * start_angle, 1e-10);
            agree("θ̇", now.state.v[1], 0.0, 1e-9);
        }
        // The ends are at rest at the same height: compare with the energy of the swing.
        let swing = 9.81 * 0.8 * (1.0 - start_angle.cos());
        let closure = trajectory.ledger().expect("sampled").closure;
        agree("ledger", closure / swing, 0.0, 1e-10);
    }
}

/// Kicked, not fast enough to go round: rolls up, slips, falls off above the height of the centre, flies a parabola, lands
/// with an impulse in the Coulomb cone.
#[test]
fn kicked_it_slips_falls_off_and_lands() {
    for (speed, mu_static, mu_kinetic) in [(5.0, 1.0, 0.8), (4.6, 0.7, 0.2), (5.2, 3.0, 0.5)] {
        let scene = SphereInBowl {
            start_speed: speed,
            mu_static,
            mu_kinetic,
            ..SphereInBowl::default()
        };
        let (g, rho, a) = (9.81, 0.8, 0.2);
        let k = g / rho;
        let trajectory = run(&scene, scene.at(<SphereInBowl>::KICKED), 1.5);
        let told = words(&trajectory);
        assert_eq!(
            told[..3],
            ["grip slips", "bowl lost", "bowl impact"],
            "{scene:?}"
        );

        let rolling = |th: f64| (speed / rho).powi(2) - 10.0 / 7.0 * k * (1.0 - th.cos());
        let onset = root(
            |th| mu_static * (rho * rolling(th) + g * th.cos()) - 2.0 / 7.0 * g * th.sin(),
            0.0,
            ((10.0 - 7.0 * speed * speed / (g * rho)) / 17.0).acos(), // N = 0
        );
        let time = integral(|th| rolling(th).sqrt().recip(), 0.0, onset);
        let slips = &trajectory.events()[0];
        agree("θ slip", slips.state.q[1], onset, 1e-10);
        agree("t slip", slips.time, time, 1e-10);

        let u = |th: f64| slipping(mu_kinetic, k, (onset, rolling(onset)), th);
        let leave = root(|th| rho * u(th) + g * th.cos(), onset, 3.0);
        let slide = integral(|d| u(onset + d).sqrt().recip(), 0.0, leave - onset);
        let spin = -rho / a * rolling(onset).sqrt()
            + integral(
                |d| {
                    let u = u(onset + d);
                    2.5 / a * mu_kinetic * (rho * u + g * (onset + d).cos()) / u.sqrt()
                },
                0.0,
                leave - onset,
            );
        let lost = &trajectory.events()[1];
        assert!(leave > 0.5 * core::f64::consts::PI);
        agree("θ leave", lost.state.q[1], leave, 1e-10);
        agree("t leave", lost.time, time + slide, 1e-10);
        agree("φ̇ leave", lost.state.v[2], spin, 1e-10);

        // The parabola meets the bowl again.
        let (s, c) = leave.sin_cos();
        let v = rho * u(leave).sqrt();
        let place = |t: f64| {
            let (x, y) = (rho * s + v * c * t, -rho * c + v * s * t - 0.5 * g * t * t);
            (x, y, v * c, v * s - g * t)
        };
        let flight = root(|t| place(t).0.hypot(place(t).1) - rho, 0.02, 1.5);
        let hit = &trajectory.events()[2];
        agree("t impact", hit.time, time + slide + flight, 1e-10);
        let (x, y, vx, vy) = place(flight);
        // Angle from the bottom, counter-clockwise; outward normal (sin, −cos), tangent (cos, sin).
        let (s, c) = (x / rho, -y / rho);
        let (normal, tangent) = (vx * s - vy * c, vx * c + vy * s);
        agree("ṙ before", hit.state.v[0], normal, 1e-9);
        agree("ρ θ̇ before", rho * hit.state.v[1], tangent, 1e-9);
        agree("ṙ after", hit.state_after.v[0], 0.0, 1e-14);
        // Of mass 1: the slip responds to a tangential impulse J with (7/2) J.
        let slip = tangent + a * spin;
        let stop = -2.0 / 7.0 * slip;
        let impulse = if stop.abs() <= mu_static * normal {
            stop
        } else {
            -slip.signum() * mu_kinetic * normal
        };
        agree("P", hit.impulses[0], normal, 1e-9);
        agree("J", hit.impulses[1], impulse, 1e-9);
        agree(
            "ρ θ̇ after",
            rho * hit.state_after.v[1],
            tangent + impulse,
            1e-9,
        );
        agree(
            "a φ̇ after",
            a * hit.state_after.v[2],
            a * spin + 2.5 * impulse,
            1e-9,
        );
        assert!(closure(&trajectory) < 1e-10);
    }
}
