//! A block on a belt, held by springs, with slips of two components: stick and slip for ever.

use super::state;
use core::f64::consts::PI;
use lagrange_core::mode::FrictionMode;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, all_agree, closure, run, run_by, words};

/// A block on a belt that runs along x, held by springs in both directions.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z + stiffness/2 * (x^2 + y^2),
    contact(belt: z >= 0),
    friction(grip on belt: slip = (der(x) - speed, der(y)), static = mu_static, kinetic = mu_kinetic),
)]
struct Belt {
    mass: f64,
    gravity: f64,
    stiffness: f64,
    speed: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

const BELT: Belt = Belt {
    mass: 1.5,
    gravity: 9.81,
    stiffness: 40.0,
    speed: 0.2,
    mu_static: 0.5,
    mu_kinetic: 0.3,
};

/// Along the belt it sticks and slips as with one component, for hundreds of cycles.
#[test]
fn stick_and_slip_along_the_belt() {
    const CYCLES: usize = 100;
    let b = BELT;
    let weight = b.mass * b.gravity;
    let (high, middle) = (
        b.mu_static * weight / b.stiffness,
        b.mu_kinetic * weight / b.stiffness,
    );
    let omega = (b.stiffness / b.mass).sqrt();
    let slide = 2.0 * (PI - (omega * (high - middle) / b.speed).atan()) / omega;
    let period = slide + 2.0 * (high - middle) / b.speed;
    let trajectory = run(
        &b,
        state(&[0.0; 3], &[0.2, 0.0, 0.0]),
        CYCLES as f64 * period + high / b.speed + 0.1,
    );
    let slips: Vec<f64> = trajectory
        .events()
        .iter()
        .filter(|e| e.kind == EventKind::Slips)
        .map(|e| e.time)
        .collect();
    assert_eq!(slips.len(), CYCLES + 1);
    agree("first", slips[0], high / b.speed, 1e-12);
    agree(
        "period",
        (slips[CYCLES] - slips[0]) / CYCLES as f64,
        period,
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-10, "{}", closure(&trajectory));
    println!("{:?}", trajectory.work());
    agree("across", trajectory.final_state().q[1], 0.0, 1e-12);
}

/// Off the line it is caught and let go in ever other directions; methods and tolerances agree.
#[test]
fn stick_and_slip_across_the_belt() {
    let start = || state(&[0.1, 0.15, 0.0], &[0.0, 0.4, 0.0]);
    let trajectory = run(&BELT, start(), 10.0);
    println!("{:?} {:?}", words(&trajectory), trajectory.work());
    assert!(words(&trajectory).len() > 5);
    assert!(closure(&trajectory) < 1e-10, "{}", closure(&trajectory));
    let end = trajectory.final_state();
    for (method, tolerance, bound) in [
        ("taylor", 1e-10, 1e-7),
        ("taylor", 1e-13, 1e-9),
        ("taylor", 1e-14, 1e-9),
        ("dop853", 1e-12, 1e-8),
        ("verner98", 1e-12, 1e-8),
        ("radau5", 1e-10, 1e-6),
    ] {
        let other = run_by(&BELT, (method, tolerance), start(), 10.0);
        assert_eq!(words(&trajectory), words(&other), "{method}");
        println!(
            "{method} {tolerance} {:e}",
            end.q[0] - other.final_state().q[0]
        );
        all_agree(method, &end.q, &other.final_state().q, bound);
    }
}

impl Belt {
    fn random(random: &mut Random, number: usize) -> Belt {
        let low = random.between(0.05, 0.6);
        Belt {
            mass: random.between(0.2, 3.0),
            gravity: 9.81,
            stiffness: random.between(1.0, 60.0),
            speed: match number % 5 {
                0 => 0.0,
                _ => random.between(0.05, 1.0),
            },
            mu_static: match number % 3 {
                0 => low,
                _ => low * random.between(1.0, 2.0),
            },
            mu_kinetic: low,
        }
    }

    /// Friction is in its cone, or against the slip.
    #[track_caller]
    fn check(&self, now: &Instant<f64>) {
        let weight = self.mass * self.gravity;
        let force = [now.forces[1], now.forces[2]];
        let size = force[0].hypot(force[1]);
        let slip = now.slips[0].hypot(now.slips[1]);
        if now.mode.frictions[0] == FrictionMode::Stick {
            assert!(size <= self.mu_static * weight * (1.0 + 1e-10), "{self:?}");
            assert!(slip < 1e-14, "{self:?}");
        } else {
            agree("size", size, self.mu_kinetic * weight, 1e-12);
            let along = force[0] * now.slips[0] + force[1] * now.slips[1];
            let against = along <= -size * slip * (1.0 - 1e-9);
            assert!(against, "{self:?}: {along} {slip}");
        }
    }
}

/// Blocks on belts of any direction, at random: friction stays in its cone and against the slip, the ledger closes.
#[test]
fn blocks_on_belts_at_random() {
    let mut random = Random::new(5);
    for number in 0..40 {
        let belt = Belt::random(&mut random, number);
        let mut four = || random.between(-0.8, 0.8);
        let v = match number % 4 {
            0 => [belt.speed, 0.0, 0.0],
            _ => [four(), four(), 0.0],
        };
        let start = state(&[four(), four(), 0.0], &v);
        let trajectory = run(&belt, start, 10.0);
        let ledger = trajectory.ledger().expect("recorded");
        let closes = ledger.closure.abs() < 1e-10 * ledger.scale.max(1.0);
        assert!(closes, "{belt:?}: {}", ledger.closure);
        let mut sampler = trajectory.sampler();
        for k in 0..200 {
            belt.check(&sampler.at(0.05 * f64::from(k)).expect("in the run"));
        }
    }
}
