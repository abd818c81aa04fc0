//! Random small systems with contacts and friction, from random starts: what must hold in every run, whatever happens.

use lagrange_core::prelude::*;
use lagrange_tests::Random;

/// A chain of three links over a rough floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[3]),
    define(
        x[k in 0..3] = sum(i in 0..k+1: length[i] * sin(theta[i])),
        y[k in 0..3] = sum(i in 0..k+1: -length[i] * cos(theta[i])),
    ),
    kinetic = sum(k in 0..3: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..3: mass[k] * 9.81 * y[k]),
    contact(floor[k in 0..3]: y[k] >= -depth, restitution = bounce),
    friction(grip[k in 0..3] on floor[k]: slip = der(x[k]), static = mu),
)]
pub struct Chain {
    pub mass: [f64; 3],
    pub length: [f64; 3],
    pub depth: f64,
    pub bounce: f64,
    pub mu: f64,
}

/// A rod that falls on a rough floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * 9.81 * y,
    contact(left: y >= half * sin(theta), restitution = bounce),
    contact(right: y + half * sin(theta) >= 0, restitution = bounce),
    friction(left_grip on left: slip = der(x - half * cos(theta)), static = mu),
    friction(right_grip on right: slip = der(x + half * cos(theta)), static = mu),
)]
pub struct Rod {
    pub mass: f64,
    pub inertia: f64,
    pub half: f64,
    pub bounce: f64,
    pub mu: f64,
}

/// Balls between two walls, neighbours tied by springs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[4]),
    kinetic = sum(k in 0..4: mass[k]/2 * der(x[k])^2),
    potential = sum(k in 0..3: stiffness/2 * (x[k+1] - x[k] - 1)^2),
    contact(left: x[0] >= 0, restitution = bounce),
    contact(pair[k in 0..3]: x[k+1] - x[k] >= 1/2, restitution = bounce),
    contact(right: x[3] <= 4, restitution = bounce),
)]
pub struct Balls {
    pub mass: [f64; 4],
    pub stiffness: f64,
    pub bounce: f64,
}

/// Two blocks on an incline, one on the other, tied to a wall by springs, the lower one driven.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s[2], n[2]),
    kinetic = sum(k in 0..2: mass[k]/2 * (der(s[k])^2 + der(n[k])^2)),
    potential(weight: sum(k in 0..2: mass[k] * 9.81 * (n[k] * cos(slope) - s[k] * sin(slope)))),
    potential(springs: sum(k in 0..2: stiffness/2 * s[k]^2)),
    contact(plane: n[0] >= 0),
    contact(top: n[1] - n[0] >= 0),
    friction(under on plane: slip = der(s[0]), static = mu),
    friction(between on top: slip = der(s[1]) - der(s[0]), static = mu),
    force(shaker: s[0] = drive * sin(rate * t)),
)]
pub struct Blocks {
    pub mass: [f64; 2],
    pub slope: f64,
    pub stiffness: f64,
    pub mu: f64,
    pub drive: f64,
    pub rate: f64,
}

/// What must hold whatever happened; `mu` is the coefficient of every friction.
#[track_caller]
pub fn obeys<S: System<Scalar = f64> + core::fmt::Debug>(
    scene: &S,
    start: State<f64>,
    until: f64,
    mu: f64,
) -> usize {
    const STEPS: usize = 10_000;
    let run = Simulation::new(scene)
        .tolerance(1e-10)
        .max_steps(STEPS)
        .run(start.clone(), 0.0..until);
    let trajectory = match run {
        Ok(trajectory) => trajectory,
        Err(Failure {
            error: Error::Limit { what: "steps", .. } | Error::NoMode { .. },
            trajectory,
        }) => *trajectory,
        Err(failure) => panic!("{failure}\n{scene:?}\n{start:?}"),
    };
    let d = S::DESCRIPTION;
    let mut sampler = trajectory.sampler();
    let times: Vec<f64> = trajectory
        .step_times()
        .chain([trajectory.last_time()])
        .collect();
    let between = times.windows(2).map(|t| 0.5 * (t[0] + t[1]));
    for t in times.iter().copied().chain(between) {
        let Ok(now) = sampler.at(t) else {
            panic!("no forces at t = {t}\n{scene:?}\n{start:?}");
        };
        let numbers = now.q.iter().chain(&now.v).chain(&now.forces);
        let finite = numbers.clone().all(|x| x.is_finite());
        assert!(finite, "t = {t}: not finite\n{scene:?}\n{start:?}");
        let weight = now.forces.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
        for (c, contact) in d.contacts.iter().enumerate() {
            let (gap, force) = (now.gaps[c], now.forces[contact.row]);
            let name = contact.name;
            assert!(
                gap > -1e-9,
                "t = {t}: {name} penetrates by {gap:e}\n{scene:?}\n{start:?}"
            );
            if now.mode.contacts[c] {
                assert!(
                    gap < 1e-9,
                    "t = {t}: {name} is closed and {gap:e} away\n{scene:?}\n{start:?}"
                );
                assert!(
                    force > -1e-7 * weight,
                    "t = {t}: {name} pulls with {force}\n{scene:?}\n{start:?}"
                );
            } else {
                assert_eq!(force, 0.0, "t = {t}: {name} is open\n{scene:?}\n{start:?}");
            }
        }
        for friction in d.frictions {
            let lagrange_core::system::Normal::Contact(c) = friction.normal else {
                continue;
            };
            let (normal, force) = (now.forces[d.contacts[c].row], now.forces[friction.row]);
            assert!(
                force.abs() <= mu * normal + 1e-7 * weight,
                "t = {t}: {} gives {force} with N = {normal}\n{scene:?}\n{start:?}",
                friction.name
            );
        }
    }
    let ledger = trajectory.ledger().expect("every step can be evaluated");
    let closure = ledger.closure.abs() / ledger.scale.max(1.0);
    assert!(
        closure < 1e-6,
        "the ledger is off by {closure:e}\n{scene:?}\n{start:?}"
    );
    trajectory.work().steps
}

fn state(q: Vec<f64>, v: Vec<f64>) -> State<f64> {
    State { q, v }
}

#[test]
fn chains_over_a_floor() {
    let mut random = Random::new(101);
    for _ in 0..40 {
        let chain = Chain {
            mass: [(); 3].map(|()| random.between(0.2, 2.0)),
            length: [(); 3].map(|()| random.between(0.3, 1.0)),
            depth: random.between(0.5, 1.5),
            bounce: random.between(0.0, 0.7),
            mu: random.between(0.0, 0.6),
        };
        // Above the floor: no link hangs below the support's half depth.
        let q: Vec<f64> = (0..3)
            .map(|_| random.sign() * random.between(1.7, 2.6))
            .collect();
        let v: Vec<f64> = (0..3).map(|_| random.between(-2.0, 2.0)).collect();
        obeys(&chain, state(q, v), 2.0, chain.mu);
    }
}

#[test]
fn rods_on_a_floor() {
    let mut random = Random::new(102);
    for _ in 0..100 {
        let rod = Rod {
            mass: random.between(0.2, 2.0),
            inertia: random.between(0.05, 0.5),
            half: random.between(0.2, 1.0),
            bounce: random.between(0.0, 0.8),
            mu: random.between(0.0, 0.8),
        };
        let q = vec![0.0, random.between(1.1, 2.0), random.between(-1.5, 1.5)];
        let v = (0..3).map(|_| random.between(-3.0, 3.0)).collect();
        obeys(&rod, state(q, v), 3.0, rod.mu);
    }
}

#[test]
fn balls_between_walls() {
    let mut random = Random::new(103);
    let mut longest = 0;
    for k in 0..40 {
        let balls = Balls {
            mass: [(); 4].map(|()| random.between(0.1, 3.0)),
            stiffness: random.between(0.0, 50.0),
            bounce: if k < 2 { 1.0 } else { random.between(0.1, 1.0) },
        };
        let q = (0..4)
            .map(|i| 0.3 + f64::from(i) + random.between(0.0, 0.4))
            .collect();
        let v = (0..4).map(|_| random.between(-3.0, 3.0)).collect();
        let until = if k < 2 { 1e4 } else { 5.0 };
        longest = longest.max(obeys(&balls, state(q, v), until, 0.0));
    }
    assert_eq!(longest, 10_000);
}

#[test]
fn blocks_on_blocks() {
    let mut random = Random::new(104);
    for k in 0..40 {
        let blocks = Blocks {
            mass: [(); 2].map(|()| random.between(0.2, 3.0)),
            slope: random.between(-0.5, 0.5),
            stiffness: random.between(5.0, 100.0),
            mu: random.between(0.05, 0.8),
            drive: random.between(0.0, 30.0),
            rate: random.between(1.0, 20.0),
        };
        let q = vec![
            random.between(-0.5, 0.5),
            random.between(-0.5, 0.5),
            0.0,
            0.0,
        ];
        let v = vec![
            random.between(-1.0, 1.0),
            random.between(-1.0, 1.0),
            0.0,
            0.0,
        ];
        obeys(
            &blocks,
            state(q, v),
            if k < 2 { 200.0 } else { 10.0 },
            blocks.mu,
        );
    }
}
