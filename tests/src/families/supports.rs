//! More supports than are needed, limits of a range, frictions that do not depend on a contact.

use super::{Family, perhaps, signed};
use crate::Random;
use lagrange_core::prelude::*;

/// A beam over four supports, of which two are enough, with a rough one.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * 9.81 * y,
    contact(support[k in 0..4]: y + place[k] * sin(theta) >= 0, restitution = bounce),
    friction(grip on support[0]: slip = der(x), static = mu),
    force(push: (pull * sin(rate * t), 0) at (x, y)),
)]
pub struct Beam {
    pub mass: f64,
    pub inertia: f64,
    pub place: [f64; 4],
    pub bounce: f64,
    pub mu: f64,
    pub pull: f64,
    pub rate: f64,
}

/// A pole on a cart between buffers, with dry friction in the wheels.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, theta),
    define(px = x + length * sin(theta), py = length * cos(theta)),
    kinetic(carriage: cart/2 * der(x)^2),
    kinetic(pole: mass/2 * (der(px)^2 + der(py)^2)),
    potential = mass * 9.81 * py,
    contact(left: x >= -1, restitution = bounce),
    contact(right: x <= 1, restitution = bounce),
    friction(wheels: slip = der(x), limit = dry),
    force(motor: push * sin(rate * t) along der(x)),
    mark(upright: theta),
    stop(turned: cos(theta) <= -turn),
)]
pub struct CartPole {
    pub cart: f64,
    pub mass: f64,
    pub length: f64,
    pub bounce: f64,
    pub dry: f64,
    pub push: f64,
    pub rate: f64,
    pub turn: f64,
}

/// A plate on three parallel cranks, of which two are enough, between a floor and a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, psi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(psi)^2,
    potential(weight: mass * 9.81 * y),
    potential(spring: stiffness/2 * x^2),
    constraint(crank[k in 0..3]: (x + place[k] * (cos(psi) - 1))^2 + (y + place[k] * sin(psi))^2 == length^2),
    dissipation(air: drag/2 * (der(x)^2 + der(y)^2)),
    contact(wall: x <= reach, restitution = bounce),
)]
pub struct Cranks {
    pub mass: f64,
    pub inertia: f64,
    pub place: [f64; 3],
    pub stiffness: f64,
    pub length: f64,
    pub drag: f64,
    pub reach: f64,
    pub bounce: f64,
}

impl Family for Beam {
    const NAME: &'static str = "beam on four supports";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let beam = Beam {
            mass: random.between(0.2, 2.0),
            inertia: random.between(0.05, 0.5),
            place: [
                random.between(-1.0, -0.6),
                random.between(-0.5, -0.1),
                random.between(0.1, 0.5),
                random.between(0.6, 1.0),
            ],
            bounce: perhaps(random, 0.6),
            mu: perhaps(random, 0.6),
            pull: perhaps(random, 10.0),
            rate: random.between(1.0, 10.0),
        };
        // Lying at rest half of the time.
        let start = if random.sign() > 0.0 {
            State::new(vec![0.0; 3], vec![0.0; 3])
        } else {
            let q = vec![0.0, random.between(1.1, 1.5), random.between(-1.0, 1.0)];
            State::new(q, signed(random, 3, 1.0))
        };
        (beam, start)
    }
}

impl Family for CartPole {
    const NAME: &'static str = "pole on a cart";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let cart = CartPole {
            cart: random.between(0.2, 2.0),
            mass: random.between(0.2, 2.0),
            length: random.between(0.3, 1.0),
            bounce: perhaps(random, 0.8),
            dry: random.between(0.0, 3.0),
            push: perhaps(random, 5.0),
            rate: random.between(0.5, 5.0),
            turn: random.between(0.5, 2.0),
        };
        let q = vec![random.between(-0.9, 0.9), random.between(-1.0, 1.0)];
        (cart, State::new(q, signed(random, 2, 2.0)))
    }
}

impl Family for Cranks {
    const NAME: &'static str = "plate on three cranks";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let length = random.between(0.5, 1.5);
        let cranks = Cranks {
            mass: random.between(0.2, 2.0),
            inertia: random.between(0.05, 0.5),
            place: [
                random.between(-1.0, -0.4),
                random.between(-0.2, 0.2),
                random.between(0.4, 1.0),
            ],
            stiffness: perhaps(random, 20.0),
            length,
            drag: perhaps(random, 0.3),
            reach: length * random.between(0.3, 0.9),
            bounce: perhaps(random, 0.8),
        };
        let (angle, rate): (f64, f64) = (random.between(-1.5, 0.2), random.between(-2.0, 2.0));
        let (sine, cosine) = (length * angle.sin(), length * angle.cos());
        let q = vec![sine, -cosine, 0.0];
        let v = vec![rate * cosine, rate * sine, 0.0];
        (cranks, State::new(q, v))
    }
}
