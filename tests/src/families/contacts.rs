//! Chains, rods, balls and blocks: contacts, impacts, friction.

use super::{Family, masses, perhaps, signed};
use crate::Random;
use lagrange_core::prelude::*;

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

impl Rod {
    pub fn random(random: &mut Random) -> Rod {
        Rod {
            mass: random.between(0.2, 2.0),
            inertia: random.between(0.05, 0.5),
            half: random.between(0.2, 1.0),
            bounce: random.between(0.0, 0.8),
            mu: random.between(0.0, 0.8),
        }
    }

    /// Above the floor, in any position and motion.
    pub fn thrown(random: &mut Random) -> State<f64> {
        State::new(
            vec![0.0, random.between(1.1, 2.0), random.between(-1.5, 1.5)],
            (0..3).map(|_| random.between(-3.0, 3.0)).collect(),
        )
    }
}

impl Balls {
    pub fn random(random: &mut Random, bounce: impl Fn(&mut Random) -> f64) -> Balls {
        Balls {
            mass: [(); 4].map(|()| random.between(0.1, 3.0)),
            stiffness: random.between(0.0, 50.0),
            bounce: bounce(random),
        }
    }

    /// Apart from each other, in any motion.
    pub fn apart(random: &mut Random) -> State<f64> {
        State::new(
            (0..4)
                .map(|i| 0.3 + f64::from(i) + random.between(0.0, 0.4))
                .collect(),
            (0..4).map(|_| random.between(-3.0, 3.0)).collect(),
        )
    }
}

impl Blocks {
    pub fn random(random: &mut Random) -> Blocks {
        Blocks {
            mass: [(); 2].map(|()| random.between(0.2, 3.0)),
            slope: random.between(-0.5, 0.5),
            stiffness: random.between(5.0, 100.0),
            mu: random.between(0.05, 0.8),
            drive: random.between(0.0, 30.0),
            rate: random.between(1.0, 20.0),
        }
    }

    /// On each other, sliding anyhow.
    pub fn sliding(random: &mut Random) -> State<f64> {
        let mut along = |size: f64| {
            vec![
                random.between(-size, size),
                random.between(-size, size),
                0.0,
                0.0,
            ]
        };
        State::new(along(0.5), along(1.0))
    }
}

/// A block on an incline.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential = mass * 9.81 * (n * cos(slope) - s * sin(slope)),
    contact(plane: n >= 0),
    friction(grip on plane: slip = der(s), static = mu),
)]
pub struct Block {
    pub mass: f64,
    pub slope: f64,
    pub mu: f64,
}

impl Family for Chain {
    const NAME: &'static str = "chain over a floor";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let chain = Chain {
            mass: masses(random),
            length: [(); 3].map(|()| random.between(0.3, 1.0)),
            depth: random.between(0.5, 1.5),
            bounce: perhaps(random, 0.7),
            mu: perhaps(random, 0.6),
        };
        // Above the floor: no link hangs below the support's half depth.
        let q = (0..3).map(|_| random.sign() * random.between(1.7, 2.6));
        let q = q.collect();
        let v = signed(random, 3, 2.0);
        (chain, State::new(q, v))
    }
}

impl Family for Rod {
    const NAME: &'static str = "rod on a floor";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        (Rod::random(random), Rod::thrown(random))
    }
}

impl Family for Balls {
    const NAME: &'static str = "balls between walls";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let balls = Balls::random(random, |random| random.between(0.1, 1.0));
        (balls, Balls::apart(random))
    }
}

impl Family for Blocks {
    const NAME: &'static str = "blocks on an incline";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        (Blocks::random(random), Blocks::sliding(random))
    }
}
