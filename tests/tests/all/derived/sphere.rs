//! The solid sphere, I = ⅖ m a², outside and inside, in r, θ, φ.
//!
//! Outside (θ from the top): ρ = R + a, slip s = ρ θ̇ − a φ̇. Inside (θ from the bottom): ρ = R − a, slip s = ρ θ̇ + a φ̇.
//! With `side` = +1 outside and −1 inside, gravity pulls along side·sin θ in the direction of θ, and s = ρ θ̇ − side a φ̇.

use super::{HandRow, STATES, Textbook, check_inertia, check_motion, check_row};
use lagrange_core::system::Derived;
use lagrange_problems::scenes::{RollingSlippingSphere, RollingSphere, SphereInBowl};
use lagrange_tests::Random;
use lagrange_tests::modes::{flight, slipping, stuck};

/// A scene with its numbers.
struct Case<S> {
    scene: S,
    side: f64,
    mass: f64,
    rho: f64,
    a: f64,
    g: f64,
    mu: f64,
}

fn rolling(random: &mut Random) -> Case<RollingSphere> {
    let scene = RollingSphere {
        mass: random.between(0.1, 5.0),
        radius: random.between(0.5, 3.0),
        sphere_radius: random.between(0.05, 0.4),
        gravity: random.between(1.0, 20.0),
        start_angle: 0.1,
    };
    Case {
        side: 1.0,
        mass: scene.mass,
        rho: scene.radius + scene.sphere_radius,
        a: scene.sphere_radius,
        g: scene.gravity,
        mu: 0.0,
        scene,
    }
}

fn outside(random: &mut Random) -> Case<RollingSlippingSphere> {
    let scene = RollingSlippingSphere {
        mass: random.between(0.1, 5.0),
        radius: random.between(0.5, 3.0),
        sphere_radius: random.between(0.05, 0.4),
        gravity: random.between(1.0, 20.0),
        mu_static: random.between(0.6, 2.0),
        mu_kinetic: random.between(0.0, 0.6),
        start_angle: 0.1,
    };
    Case {
        side: 1.0,
        mass: scene.mass,
        rho: scene.radius + scene.sphere_radius,
        a: scene.sphere_radius,
        g: scene.gravity,
        mu: scene.mu_kinetic,
        scene,
    }
}

fn inside(random: &mut Random) -> Case<SphereInBowl> {
    let scene = SphereInBowl {
        mass: random.between(0.1, 5.0),
        radius: random.between(0.5, 3.0),
        sphere_radius: random.between(0.05, 0.4),
        gravity: random.between(1.0, 20.0),
        mu_static: random.between(0.6, 2.0),
        mu_kinetic: random.between(0.0, 0.6),
        start_angle: 0.1,
        start_speed: 1.0,
    };
    Case {
        side: -1.0,
        mass: scene.mass,
        rho: scene.radius - scene.sphere_radius,
        a: scene.sphere_radius,
        g: scene.gravity,
        mu: scene.mu_kinetic,
        scene,
    }
}

/// A state that touches, with any slip; then with none.
fn touching<S>(case: &Case<S>, random: &mut Random, rolls: bool) -> ([f64; 3], [f64; 3]) {
    let q = [
        case.rho,
        random.between(-3.0, 3.0),
        random.between(-9.0, 9.0),
    ];
    let td = random.between(-3.0, 3.0);
    let rolling = case.side * case.rho * td / case.a;
    let pd = if rolls {
        rolling
    } else {
        random.between(-20.0, 20.0)
    };
    (q, [0.0, td, pd])
}

/// The normal force, and the tangential acceleration ρ θ̈ = side g sin θ + F/m for a tangential force F.
fn newton<S>(case: &Case<S>, q: &[f64; 3], v: &[f64; 3], tangential: f64) -> (f64, f64) {
    let normal = case.mass * (case.g * q[1].cos() - case.side * case.rho * v[1] * v[1]);
    let theta = (case.side * case.g * q[1].sin() + tangential / case.mass) / case.rho;
    (normal, theta)
}

/// Rows are (friction or rolling, contact) in the order of the scene; `contact_first` says which.
fn forces(contact_first: bool, normal: f64, tangential: f64) -> Vec<f64> {
    if contact_first {
        vec![normal, tangential]
    } else {
        vec![tangential, normal]
    }
}

fn rolls<S: Derived<Scalar = f64>>(
    seed: u64,
    build: fn(&mut Random) -> Case<S>,
    contact_first: bool,
) {
    let mut random = Random::new(seed);
    for _ in 0..STATES {
        let case = build(&mut random);
        let (q, v) = touching(&case, &mut random, true);
        // m ρ θ̈ = side m g sin θ + F and ⅖ m a (side ρ θ̈) = −side a F give F = −(2/7) side m g sin θ.
        let tangential = -2.0 / 7.0 * case.side * case.mass * case.g * q[1].sin();
        let (normal, theta) = newton(&case, &q, &v, tangential);
        let expected = 5.0 / 7.0 * case.side * case.g * q[1].sin() / case.rho;
        assert!((theta - expected).abs() < 1e-12 * (1.0 + expected.abs()));
        let book = Textbook {
            acceleration: vec![0.0, expected, case.side * case.rho * expected / case.a],
            force: forces(contact_first, normal, tangential),
        };
        check_motion(&case.scene, &stuck::<S>(), &q, &v, &book);
    }
}

#[test]
fn sphere_rolls() {
    rolls(10, rolling, false);
}

#[test]
fn real_sphere_rolls() {
    rolls(11, outside, true);
}

#[test]
fn sphere_rolls_in_bowl() {
    rolls(12, inside, true);
}

fn slips<S: Derived<Scalar = f64>>(seed: u64, build: fn(&mut Random) -> Case<S>) {
    for sign in [1.0, -1.0] {
        let mut random = Random::new(seed);
        for _ in 0..STATES {
            let case = build(&mut random);
            let (q, v) = touching(&case, &mut random, false);
            let (normal, _) = newton(&case, &q, &v, 0.0);
            let tangential = -sign * case.mu * normal;
            let (_, theta) = newton(&case, &q, &v, tangential);
            let inertia = 0.4 * case.mass * case.a * case.a;
            let book = Textbook {
                acceleration: vec![0.0, theta, -case.side * case.a * tangential / inertia],
                force: forces(true, normal, tangential),
            };
            check_motion(&case.scene, &slipping::<S>(sign), &q, &v, &book);
        }
    }
}

#[test]
fn real_sphere_slips_both_ways() {
    slips(13, outside);
}

#[test]
fn sphere_slips_in_bowl_both_ways() {
    slips(14, inside);
}

/// Anywhere: M = diag(m, m r², I); the forces of a parabola with spin; the contact and the slip as rows.
fn inertia_and_flight<S: Derived<Scalar = f64>>(
    seed: u64,
    build: fn(&mut Random) -> Case<S>,
    contact_first: bool,
) {
    let mut random = Random::new(seed);
    for _ in 0..STATES {
        let case = build(&mut random);
        let (m, g, side) = (case.mass, case.side * case.g, case.side);
        let q = [
            random.between(0.3, 4.0),
            random.between(-3.0, 3.0),
            random.between(-9.0, 9.0),
        ];
        let v: [f64; 3] = core::array::from_fn(|_| random.between(-3.0, 3.0));
        let ([r, theta, _], [rd, td, pd]) = (q, v);
        let inertia = 0.4 * m * case.a * case.a;
        let mass = [
            vec![m, 0.0, 0.0],
            vec![0.0, m * r * r, 0.0],
            vec![0.0, 0.0, inertia],
        ];
        let forcing = [
            m * r * td * td - m * g * theta.cos(),
            -2.0 * m * r * rd * td + m * g * r * theta.sin(),
            0.0,
        ];
        let contact = HandRow {
            jacobian: vec![side, 0.0, 0.0],
            bias: 0.0,
            position: side * (r - case.rho),
            velocity: side * rd,
        };
        let slip = HandRow {
            jacobian: vec![0.0, case.rho, -side * case.a],
            bias: 0.0,
            position: 0.0,
            velocity: case.rho * td - side * case.a * pd,
        };
        let (contact_row, slip_row) = if contact_first { (0, 1) } else { (1, 0) };
        for mode in [flight::<S>(), stuck::<S>(), slipping::<S>(random.sign())] {
            check_inertia(&case.scene, &mode, &q, &v, &mass, &forcing);
            check_row(&case.scene, &mode, &q, &v, contact_row, &contact);
            check_row(&case.scene, &mode, &q, &v, slip_row, &slip);
        }
        let book = Textbook {
            acceleration: vec![
                r * td * td - g * theta.cos(),
                (g * theta.sin() - 2.0 * rd * td) / r,
                0.0,
            ],
            force: vec![0.0, 0.0],
        };
        check_motion(&case.scene, &flight::<S>(), &q, &v, &book);
    }
}

#[test]
fn sphere_inertia_rows_and_flight() {
    inertia_and_flight(15, rolling, false);
}

#[test]
fn real_sphere_inertia_rows_and_flight() {
    inertia_and_flight(16, outside, true);
}

#[test]
fn bowl_inertia_rows_and_flight() {
    inertia_and_flight(17, inside, true);
}
