//! Motions in space: a puck with friction in two directions, a body on a quaternion, a charge in a magnetic field.

use super::{Family, masses, perhaps, signed};
use crate::Random;
use lagrange_core::prelude::*;

/// A puck above a rough table, on a spring.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential(weight: mass * 9.81 * z),
    potential(spring: stiffness/2 * (x^2 + 2*y^2)),
    contact(table: z >= 0, restitution = bounce),
    friction(grip on table: slip = (der(x), der(y)), static = rough * mu, kinetic = mu),
    dissipation(air: drag/2 * (der(x)^2 + der(y)^2)),
)]
pub struct Puck {
    pub mass: f64,
    pub stiffness: f64,
    pub bounce: f64,
    pub mu: f64,
    pub rough: f64,
    pub drag: f64,
}

/// A rigid body held at its centre of mass, with a spring that turns one axis upward and a stop for it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    attitude(body: q),
    kinetic = sum(k in 0..3: inertia[k]/2 * body.body_rate[k]^2),
    potential(spring: -stiffness * body.axes[2][2]),
    dissipation(oil: sum(k in 0..3: drag/2 * body.body_rate[k]^2)),
    contact(stop: body.axes[2][2] >= lowest, restitution = bounce),
)]
pub struct Body {
    pub inertia: [f64; 3],
    pub stiffness: f64,
    pub drag: f64,
    pub lowest: f64,
    pub bounce: f64,
}

/// A charge in a magnetic field and a well, given by its Lagrangian, between plates.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    lagrangian = mass/2 * (der(x)^2 + der(y)^2) + field/2 * (x * der(y) - y * der(x)) - depth * (x^2 + y^2)^2,
    contact(plate: x <= 1, restitution = bounce),
    force(beam: (push * cos(rate * t), 0) at (x, y)),
    force(brake: -drag * der(y) along der(y)),
    mark(crossing: y),
)]
pub struct Charge {
    pub mass: f64,
    pub field: f64,
    pub depth: f64,
    pub push: f64,
    pub rate: f64,
    pub drag: f64,
    pub bounce: f64,
}

impl Family for Puck {
    const NAME: &'static str = "puck on a table";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let puck = Puck {
            mass: random.between(0.2, 2.0),
            stiffness: perhaps(random, 20.0),
            bounce: perhaps(random, 0.8),
            mu: random.between(0.05, 0.6),
            rough: random.between(1.0, 1.5),
            drag: perhaps(random, 0.5),
        };
        let mut q = signed(random, 2, 0.5);
        q.push(perhaps(random, 0.5));
        (puck, State::new(q, signed(random, 3, 2.0)))
    }
}

impl Family for Body {
    const NAME: &'static str = "body on a quaternion";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let body = Body {
            inertia: masses(random),
            stiffness: perhaps(random, 10.0),
            drag: perhaps(random, 0.2),
            lowest: random.between(-0.9, 0.5),
            bounce: perhaps(random, 0.8),
        };
        let mut v = signed(random, 4, 2.0);
        v[0] = 0.0;
        (body, State::new(vec![1.0, 0.0, 0.0, 0.0], v))
    }
}

impl Family for Charge {
    const NAME: &'static str = "charge in a magnetic field";

    fn draw(random: &mut Random) -> (Self, State<f64>) {
        let charge = Charge {
            mass: random.between(0.2, 2.0),
            field: random.between(-3.0, 3.0),
            depth: random.between(0.5, 5.0),
            push: perhaps(random, 3.0),
            rate: random.between(0.5, 5.0),
            drag: perhaps(random, 0.3),
            bounce: perhaps(random, 0.9),
        };
        (
            charge,
            State::new(signed(random, 2, 0.9), signed(random, 2, 2.0)),
        )
    }
}
