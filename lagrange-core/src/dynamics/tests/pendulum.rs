//! Fixture: a point mass on a unit rod in Cartesian coordinates x, y (y up), with rows that depend on one another.

use crate::prelude::*;
use crate::system::Description;

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic(across: mass * der(x)^2 / 2),
    kinetic(up: mass * der(y)^2 / 2),
    potential = mass * gravity * y,
    constraint(rod: x^2 + y^2 == 1),
    // Without skew the same rod again.
    constraint(twin: 2 * (x^2 + y^2) + skew * x == 2),
    // Without skew the same rod growing.
    constraint(growing: x^2 + y^2 + skew * y == 1 + t^2),
)]
pub struct Pendulum {
    pub mass: f64,
    pub gravity: f64,
    pub skew: f64,
}

pub const ROD: usize = 0;
pub const TWIN: usize = 1;
pub const GROWING: usize = 2;

pub const PENDULUM: &Description = <Pendulum as Derived>::DESCRIPTION;
