//! Supports and surfaces that move as time says.

use super::{Family, perhaps, signed};
use crate::Random;
use lagrange_core::prelude::*;

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
pub struct Shaken {
    pub mass: f64,
    pub length: f64,
    pub reach: f64,
    pub lift: f64,
    pub rate: f64,
    pub depth: f64,
    pub bounce: f64,
    pub mu: f64,
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
pub struct Feeder {
    pub mass: f64,
    pub reach: f64,
    pub lift: f64,
    pub rate: f64,
    pub bounce: f64,
    pub mu: f64,
}

impl Family for Shaken {
    const NAME: &'static str = "shaken pendulum";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let length = random.between(0.5, 1.5);
        let shaken = Shaken {
            mass: random.between(0.2, 2.0),
            length,
            reach: random.between(0.0, 0.3),
            lift: random.between(0.0, 0.1),
            rate: random.between(1.0, 10.0),
            depth: length * random.between(0.5, 0.8),
            bounce: perhaps(random, 0.8),
            mu: perhaps(random, 0.5),
        };
        let angle = random.sign() * random.between(1.4, 2.8);
        let q = vec![length * angle.sin(), shaken.lift - length * angle.cos()];
        let v = signed(random, 2, 2.0);
        (shaken, State::new(q, v))
    }
}

impl Family for Feeder {
    const NAME: &'static str = "block on a shaken plate";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let feeder = Feeder {
            mass: random.between(0.2, 2.0),
            reach: random.between(0.0, 0.02),
            lift: random.between(0.0, 0.02),
            rate: random.between(5.0, 40.0),
            bounce: perhaps(random, 0.8),
            mu: random.between(0.05, 0.5),
        };
        let q = vec![0.0, feeder.lift.max(random.between(0.0, 0.3))];
        let v = signed(random, 2, 1.0);
        (feeder, State::new(q, v))
    }
}
