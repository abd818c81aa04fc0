//! Fixture: a mass on the rim of a rolling wheel, driven by a torque that grows. Coordinates x, φ, r, θ (θ from the vertical).

use crate::arithmetic::Scalar;
use crate::mode::{FrictionMode, Mode};
use crate::prelude::*;
use crate::system::Description;

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, phi, r, theta),
    define(across = x + r * sin(theta), up = r * cos(theta)),
    kinetic(rolls: wheel * der(x)^2 / 2 + inertia * der(phi)^2 / 2),
    kinetic(moves: mass * (der(across)^2 + der(up)^2) / 2),
    potential = mass * gravity * up,
    force(drive: phi = 3/10 * t),
    constraint(rolling: der(x) == radius * der(phi)),
    contact(rim: r >= radius),
    friction(grip on rim: slip = radius * (der(theta) - der(phi)), static = mu_static, kinetic = mu_kinetic),
    observe(lift = rim^2 + der(der(r))),
)]
pub struct Wheel<T = f64> {
    pub wheel: T,
    pub inertia: T,
    pub mass: T,
    pub radius: T,
    pub gravity: T,
    pub mu_static: T,
    pub mu_kinetic: T,
}

impl<T: Scalar> Wheel<T> {
    pub fn example() -> Self {
        let number = T::from_f64;
        Self {
            wheel: number(2.0),
            inertia: number(1.3),
            mass: number(0.7),
            radius: number(1.1),
            gravity: number(9.81),
            mu_static: number(0.9),
            mu_kinetic: number(0.5),
        }
    }
}

// Rows.
pub const ROLLING: usize = 0;
pub const RIM: usize = 1;
pub const GRIP: usize = 2;

pub const WHEEL: &Description = <Wheel as Derived>::DESCRIPTION;

/// The mass at rest on the rim.
pub fn stuck() -> Mode {
    Mode {
        contacts: vec![true],
        frictions: vec![FrictionMode::Stick],
        branches: vec![],
    }
}
