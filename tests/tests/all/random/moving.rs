//! Supports and surfaces that move as time says.

use super::{Tally, Trial};
use lagrange_core::prelude::*;
use lagrange_tests::Random;

/// A pendulum whose support is shaken, over a floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * 9.81 * y,
    constraint(rod: (x - reach * sin(rate * t))^2 + (y - lift * cos(rate * t))^2 == length^2),
    contact(floor: y >= -depth, restitution = bounce),
    friction(grip on floor: slip = der(x), static = mu),
)]
struct Shaken {
    mass: f64,
    length: f64,
    reach: f64,
    lift: f64,
    rate: f64,
    depth: f64,
    bounce: f64,
    mu: f64,
}

/// A block on a plate that is shaken up and down and to and fro.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * 9.81 * y,
    contact(plate: y >= lift * sin(rate * t), restitution = bounce),
    friction(grip on plate: slip = der(x) - reach * rate * cos(rate * t), static = 1.5 * mu, kinetic = mu),
)]
struct Feeder {
    mass: f64,
    reach: f64,
    lift: f64,
    rate: f64,
    bounce: f64,
    mu: f64,
}

#[test]
fn shaken_pendulums() {
    let mut random = Random::new(301);
    let mut tally = Tally::default();
    for _ in 0..40 {
        let length = random.between(0.5, 1.5);
        let shaken = Shaken {
            mass: random.between(0.2, 2.0),
            length,
            reach: random.between(0.0, 0.3),
            lift: random.between(0.0, 0.1),
            rate: random.between(1.0, 10.0),
            depth: length * random.between(0.5, 0.8),
            bounce: random.between(0.0, 0.8),
            mu: random.between(0.0, 0.5),
        };
        let angle = random.sign() * random.between(1.4, 2.8);
        let q = vec![length * angle.sin(), shaken.lift - length * angle.cos()];
        let v = vec![random.between(-2.0, 2.0), random.between(-2.0, 2.0)];
        tally.run(&shaken, &State { q, v }, Trial::until(4.0).rough(shaken.mu));
    }
    tally.check();
}

#[test]
fn feeders() {
    let mut random = Random::new(302);
    let mut tally = Tally::default();
    for k in 0..40 {
        let feeder = Feeder {
            mass: random.between(0.2, 2.0),
            reach: random.between(0.0, 0.02),
            lift: random.between(0.0, 0.02),
            rate: random.between(5.0, 40.0),
            bounce: random.between(0.0, 0.8),
            mu: random.between(0.05, 0.5),
        };
        let q = vec![0.0, random.between(0.0, 0.3)];
        let v = vec![random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
        let until = if k < 2 { 300.0 } else { 5.0 };
        let trial = Trial::until(until).rough(1.5 * feeder.mu);
        tally.run(&feeder, &State { q, v }, trial);
    }
    tally.check();
    assert_eq!(tally.longest, 10_000);
}
