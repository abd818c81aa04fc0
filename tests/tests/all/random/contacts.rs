//! Chains over a floor, rods on it, balls between walls, blocks on blocks.

use super::{Tally, Trial};
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

#[test]
fn chains_over_a_floor() {
    let mut random = Random::new(101);
    let mut tally = Tally::default();
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
        tally.run(&chain, &State { q, v }, Trial::until(2.0).rough(chain.mu));
    }
    tally.check();
}

#[test]
fn rods_on_a_floor() {
    let mut random = Random::new(102);
    let mut tally = Tally::default();
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
        tally.run(&rod, &State { q, v }, Trial::until(3.0).rough(rod.mu));
    }
    tally.check();
}

#[test]
fn balls_between_walls() {
    let mut random = Random::new(103);
    let mut tally = Tally::default();
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
        tally.run(&balls, &State { q, v }, Trial::until(until));
    }
    tally.check();
    assert_eq!(tally.longest, 10_000);
}

#[test]
fn blocks_on_blocks() {
    let mut random = Random::new(104);
    let mut tally = Tally::default();
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
        let until = if k < 2 { 200.0 } else { 10.0 };
        tally.run(
            &blocks,
            &State { q, v },
            Trial::until(until).rough(blocks.mu),
        );
    }
    tally.check();
}
