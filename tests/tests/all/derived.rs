//! What the macro derives against what a textbook derives by hand, for every mode of every scene, at random states.

use lagrange_core::dynamics::Dynamics;
use lagrange_core::effects::Effects;
use lagrange_core::mode::Sliding;
use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;
use lagrange_tests::{Random, agree};

const STATES: usize = 200;

fn mode(closed: bool, frictions: &[FrictionMode]) -> Mode {
    Mode {
        contacts: vec![closed],
        frictions: frictions.to_vec(),
        branches: vec![],
    }
}

fn slip(sign: f64) -> FrictionMode {
    FrictionMode::Slip(Sliding::sign(sign))
}

/// Accelerations and multipliers of a scene in a mode.
fn solve<S: System<Scalar = f64>>(scene: &S, mode: &Mode, q: &[f64], v: &[f64]) -> Dynamics<S> {
    let mut dynamics = Dynamics::new(scene, &Effects::all());
    dynamics.set_mode(mode);
    dynamics.value(0.3, q, v).expect("a regular state");
    dynamics
}

#[track_caller]
fn all_agree(what: &str, derived: &[f64], by_hand: &[f64]) {
    assert_eq!(derived.len(), by_hand.len(), "{what}");
    for (i, (a, b)) in derived.iter().zip(by_hand).enumerate() {
        agree(&format!("{what}[{i}]"), *a, *b, 1e-11);
    }
}

#[test]
fn mass_on_a_shell_slides_and_flies() {
    let mut random = Random::new(1);
    for _ in 0..STATES {
        let [m, radius, g] = [0; 3].map(|_| random.between(0.2, 5.0));
        let scene = MassOnShell {
            mass: m,
            radius,
            gravity: g,
            start_angle: 0.0,
        };
        let (th, w, vr) = (
            random.between(-3.0, 3.0),
            random.between(-4.0, 4.0),
            random.between(-2.0, 2.0),
        );
        let r = radius * random.between(1.0, 2.0);

        let flight = solve(&scene, &mode(false, &[]), &[r, th], &[vr, w]);
        all_agree(
            "M",
            flight.mass_matrix().as_slice(),
            &[m, 0.0, 0.0, m * r * r],
        );
        let f = [
            m * r * w * w - m * g * th.cos(),
            -2.0 * m * r * vr * w + m * g * r * th.sin(),
        ];
        all_agree("f", flight.forcing().as_slice(), &f);
        all_agree("v̇", flight.acceleration(), &[f[0] / m, f[1] / (m * r * r)]);

        let slide = solve(&scene, &mode(true, &[]), &[radius, th], &[0.0, w]);
        all_agree("v̇", slide.acceleration(), &[0.0, g * th.sin() / radius]);
        let normal = m * g * th.cos() - m * radius * w * w;
        all_agree("N", slide.multipliers().as_slice(), &[normal]);
    }
}

#[test]
fn a_sphere_rolls_and_flies() {
    let mut random = Random::new(2);
    for _ in 0..STATES {
        let [m, radius, a, g] = [0; 4].map(|_| random.between(0.2, 5.0));
        let scene = RollingSphere {
            mass: m,
            radius,
            sphere_radius: a,
            gravity: g,
            start_angle: 0.0,
        };
        let (th, w) = (random.between(-3.0, 3.0), random.between(-4.0, 4.0));
        let c = radius + a;
        let roll = solve(
            &scene,
            &mode(true, &[]),
            &[c, th, 0.4],
            &[0.0, w, c * w / a],
        );
        let angular = 5.0 / 7.0 * g * th.sin() / c;
        all_agree("v̇", roll.acceleration(), &[0.0, angular, c * angular / a]);
        // Rows: rolling, then the shell. The rolling multiplier pushes along +∇(R θ̇ − a(φ̇ − θ̇)): against the turn.
        let (normal, grip) = (
            m * g * th.cos() - m * c * w * w,
            -2.0 / 7.0 * m * g * th.sin(),
        );
        all_agree("λ", roll.multipliers().as_slice(), &[grip, normal]);
        let inertia = 0.4 * m * a * a;
        all_agree(
            "A",
            roll.constraint_jacobian().transpose().as_slice(),
            &[0.0, c, -a, 1.0, 0.0, 0.0],
        );

        let (r, vr, spin) = (
            c * random.between(1.0, 2.0),
            random.between(-2.0, 2.0),
            random.between(-9.0, 9.0),
        );
        let flight = solve(&scene, &mode(false, &[]), &[r, th, 0.4], &[vr, w, spin]);
        let diagonal = flight.mass_matrix().diagonal();
        all_agree("M", diagonal.as_slice(), &[m, m * r * r, inertia]);
        all_agree(
            "v̇",
            flight.acceleration(),
            &[
                r * w * w - g * th.cos(),
                (g * th.sin() - 2.0 * vr * w) / r,
                0.0,
            ],
        );
    }
}

#[test]
fn a_sphere_sticks_and_slips_both_ways_outside_and_inside() {
    let mut random = Random::new(3);
    for _ in 0..STATES {
        let [m, a, g] = [0; 3].map(|_| random.between(0.2, 3.0));
        let radius = a * random.between(1.5, 6.0);
        let (mu_static, mu_kinetic) = (random.between(0.1, 1.0), random.between(0.0, 1.0));
        let (th, w, spin) = (
            random.between(-1.2, 1.2),
            random.between(-0.5, 0.5),
            random.between(-4.0, 4.0),
        );
        let inertia = 0.4 * m * a * a;

        let c = radius + a;
        let outside = RollingSlippingSphere {
            mass: m,
            radius,
            sphere_radius: a,
            gravity: g,
            mu_static,
            mu_kinetic,
            ..RollingSlippingSphere::default()
        };
        let normal = m * g * th.cos() - m * c * w * w;
        for sign in [1.0, -1.0] {
            let slide = solve(
                &outside,
                &mode(true, &[slip(sign)]),
                &[c, th, 0.0],
                &[0.0, w, spin],
            );
            let friction = -sign * mu_kinetic * normal;
            let expected = [
                0.0,
                g * th.sin() / c + friction / (m * c),
                -a * friction / inertia,
            ];
            all_agree("slipping outside", slide.acceleration(), &expected);
            agree("N", slide.force(0), normal, 1e-11);
            agree("F", slide.force(1), friction, 1e-11);
        }
        let stick = solve(
            &outside,
            &mode(true, &[FrictionMode::Stick]),
            &[c, th, 0.0],
            &[0.0, w, c * w / a],
        );
        agree(
            "stick F",
            stick.force(1),
            -2.0 / 7.0 * m * g * th.sin(),
            1e-11,
        );

        let c = radius - a;
        let inside = SphereInBowl {
            mass: m,
            radius,
            sphere_radius: a,
            gravity: g,
            mu_static,
            mu_kinetic,
            ..SphereInBowl::default()
        };
        let normal = m * g * th.cos() + m * c * w * w;
        for sign in [1.0, -1.0] {
            let slide = solve(
                &inside,
                &mode(true, &[slip(sign)]),
                &[c, th, 0.0],
                &[0.0, w, spin],
            );
            let friction = -sign * mu_kinetic * normal;
            let expected = [
                0.0,
                -g * th.sin() / c + friction / (m * c),
                a * friction / inertia,
            ];
            all_agree("slipping inside", slide.acceleration(), &expected);
            agree("N", slide.force(0), normal, 1e-11);
        }
        let stick = solve(
            &inside,
            &mode(true, &[FrictionMode::Stick]),
            &[c, th, 0.0],
            &[0.0, w, -c * w / a],
        );
        let angular = -5.0 / 7.0 * g * th.sin() / c;
        all_agree(
            "rolling inside",
            stick.acceleration(),
            &[0.0, angular, -c * angular / a],
        );
    }
}

#[test]
fn the_wheel_with_its_mass_stuck_slipping_and_flying() {
    let mut random = Random::new(4);
    for _ in 0..STATES {
        let [m, wheel, radius, g] = [0; 4].map(|_| random.between(0.3, 3.0));
        let inertia = wheel * radius * radius * random.between(0.3, 1.0);
        let (mu_static, mu_kinetic) = (random.between(0.1, 1.0), random.between(0.0, 0.4));
        let scene = MassOnWheel {
            wheel,
            inertia,
            mass: m,
            radius,
            gravity: g,
            mu_static,
            mu_kinetic,
            start_angle: 0.0,
        };
        let (th, w, vr, turn) = (
            random.between(-1.2, 1.2),
            random.between(-1.0, 1.0),
            random.between(-1.0, 1.0),
            random.between(-1.0, 1.0),
        );
        let (s, c) = th.sin_cos();
        let vx = radius * turn;

        // Free flight beside the rolling wheel: the wheel keeps its speed, the mass falls.
        let r = radius * random.between(1.0, 2.0);
        let flight = solve(
            &scene,
            &mode(false, &[FrictionMode::Inactive]),
            &[0.0, 0.0, r, th],
            &[vx, turn, vr, w],
        );
        all_agree(
            "flight",
            flight.acceleration(),
            &[0.0, 0.0, r * w * w - g * c, (g * s - 2.0 * vr * w) / r],
        );
        let m_x = [wheel + m, 0.0, m * s, m * r * c];
        all_agree(
            "M row x",
            flight.mass_matrix().row(0).transpose().as_slice(),
            &m_x,
        );

        // Stuck, one degree of freedom θ = φ + const: T = ½ θ̇² (I + (M + m) R² + m R² + 2 m R² cos θ).
        let stuck = solve(
            &scene,
            &mode(true, &[FrictionMode::Stick]),
            &[0.0, 0.0, radius, th],
            &[radius * w, w, 0.0, w],
        );
        let total = inertia + (wheel + 2.0 * m) * radius * radius + 2.0 * m * radius * radius * c;
        let angular = (m * g * radius * s + m * radius * radius * s * w * w) / total;
        all_agree(
            "stuck",
            stuck.acceleration(),
            &[radius * angular, angular, 0.0, angular],
        );
        // Newton for the mass: radial and tangential.
        let (ax, ay) = (
            radius * angular + radius * (angular * c - w * w * s),
            -radius * (angular * s + w * w * c),
        );
        let force = (m * ax, m * (ay + g));
        agree("stuck N", stuck.force(1), force.0 * s + force.1 * c, 1e-11);
        agree("stuck F", stuck.force(2), force.0 * c - force.1 * s, 1e-11);

        // Slipping: θ and φ free; F = −σ μ N on the mass along +θ, −F on the rim.
        for sign in [1.0, -1.0] {
            let q = [0.0, 0.0, radius, th];
            let slide = solve(&scene, &mode(true, &[slip(sign)]), &q, &[vx, turn, 0.0, w]);
            let k = -sign * mu_kinetic;
            // Unknowns (θ̈, φ̈, N): tangential, radial, and the wheel about its contact with the floor.
            let rows = nalgebra::Matrix3::new(
                m * radius,
                m * radius * c,
                -k,
                0.0,
                m * radius * s,
                -1.0,
                0.0,
                inertia + wheel * radius * radius,
                radius * (s + k * c) + k * radius,
            );
            let right = nalgebra::Vector3::new(m * g * s, m * radius * w * w - m * g * c, 0.0);
            let x = rows.lu().solve(&right).expect("regular");
            all_agree(
                "slipping",
                slide.acceleration(),
                &[radius * x[1], x[1], 0.0, x[0]],
            );
            agree("slipping N", slide.force(1), x[2], 1e-10);
            agree("slipping F", slide.force(2), k * x[2], 1e-10);
        }
    }
}
