//! A car whose front brake rubs while its rear wheels are locked: both slips end at one instant, and then all four frictions hold it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, SINGLE_METHODS, TOLERANCES, agree, methods_at, run_by};

/// The front axle turns by a, the rear one by b.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, a, b),
    kinetic = mass/2 * der(x)^2 + inertia/2 * (der(a)^2 + der(b)^2),
    potential = weight * sin(slope) * x,
    friction(front: slip = der(x) - radius * der(a), normal = weight * cos(slope) * (1 - rear_share),
        static = mu_static, kinetic = mu_kinetic),
    friction(rear: slip = der(x) - radius * der(b), normal = weight * cos(slope) * rear_share,
        static = mu_static, kinetic = mu_kinetic),
    friction(front_brake: slip = der(a), limit = (6/5 * brake, brake)),
    friction(rear_brake: slip = der(b), limit = lock),
)]
struct Car {
    mass: f64,
    inertia: f64,
    radius: f64,
    slope: f64,
    weight: f64,
    rear_share: f64,
    mu_static: f64,
    mu_kinetic: f64,
    brake: f64,
    lock: f64,
}

/// (m + J/r²) v̇ = −G sin α − μ G cos α · share − brake/r until it stands.
#[test]
fn a_car_that_has_stopped_slips_nowhere() {
    let mut random = Random::new(7);
    for _ in 0..20 {
        let mass = random.between(5.0, 12.0);
        let scene = Car {
            mass,
            inertia: random.between(0.05, 0.2),
            radius: random.between(0.2, 0.4),
            slope: random.between(0.1, 0.25),
            weight: mass * random.between(5.0, 10.0),
            rear_share: random.between(0.35, 0.5),
            mu_static: 0.6,
            mu_kinetic: random.between(0.4, 0.5),
            brake: random.between(2.0, 4.0),
            lock: 40.0,
        };
        let speed = random.between(2.0, 8.0);
        let along = scene.weight * scene.slope.sin();
        let rubs = scene.mu_kinetic * scene.weight * scene.slope.cos() * scene.rear_share;
        let inertia = scene.mass + scene.inertia / scene.radius.powi(2);
        let stands = speed * inertia / (along + rubs + scene.brake / scene.radius);
        for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
            let start = state(&[0.0; 3], &[speed, speed / scene.radius, 0.0]);
            let motion = run_by(&scene, (method, tolerance), start, stands + 1.0);
            let (mode, events) = (motion.final_mode(), motion.events());
            let asked = format!("{method} {tolerance:e} {scene:?}");
            let all = [Car::FRONT, Car::REAR, Car::FRONT_BRAKE, Car::REAR_BRAKE];
            assert!(all.iter().all(|f| mode.sticks(*f)), "{asked}: {mode:?}");
            assert_eq!(events.len(), 2, "{asked}");
            for event in events {
                assert_eq!(event.kind, EventKind::Sticks, "{asked}");
                agree(&asked, event.time, stands, 10.0 * tolerance);
            }
        }
    }
}
