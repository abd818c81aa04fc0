//! temporary
use lagrange_core::prelude::*;

/// Two links.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[2]),
    define(x[k in 0..2] = sum(i in 0..k+1: l*sin(theta[i])), y[k in 0..2] = -sum(i in 0..k+1: l*cos(theta[i]))),
    kinetic = sum(k in 0..2: mass/2*(der(x[k])^2+der(y[k])^2)),
    potential = sum(k in 0..2: mass*gravity*y[k]),
    start(held: theta[0] = 2, theta[1] = 5/2),
)]
pub struct DoublePendulum<T = f64> {
    pub mass: T,
    pub gravity: T,
    pub l: T,
}
impl Default for DoublePendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            gravity: 9.81,
            l: 1.0,
        }
    }
}

/// Five links.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[5]),
    define(x[k in 0..5] = sum(i in 0..k+1: l*sin(theta[i])), y[k in 0..5] = -sum(i in 0..k+1: l*cos(theta[i]))),
    kinetic = sum(k in 0..5: mass/2*(der(x[k])^2+der(y[k])^2)),
    potential = sum(k in 0..5: mass*gravity*y[k]),
    start(held: theta[0] = 0.5, theta[1] = 0.7, theta[2] = 0.9, theta[3] = 1.1, theta[4] = 1.3),
)]
pub struct Chain<T = f64> {
    pub mass: T,
    pub gravity: T,
    pub l: T,
}
impl Default for Chain {
    fn default() -> Self {
        Self {
            mass: 1.0,
            gravity: 9.81,
            l: 1.0,
        }
    }
}

/// Rod.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x^2 + y^2 == l^2),
    start(held: x = l),
)]
pub struct CartesianPendulum<T = f64> {
    pub mass: T,
    pub gravity: T,
    pub l: T,
}
impl Default for CartesianPendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            gravity: 9.81,
            l: 1.0,
        }
    }
}

/// Kepler.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = -mu / sqrt(x^2 + y^2),
    start(pericentre: x = 1 - e, der(y) = sqrt((1+e)/(1-e))),
)]
pub struct Kepler<T = f64> {
    pub mu: T,
    pub e: T,
}
impl Default for Kepler {
    fn default() -> Self {
        Self { mu: 1.0, e: 0.9 }
    }
}

/// Spring.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r, theta),
    kinetic = mass/2*(der(r)^2 + r^2*der(theta)^2),
    potential(weight: -mass*gravity*r*cos(theta)),
    potential(spring: stiffness/2*(r - l)^2),
    start(held: r = l, theta = 1),
)]
pub struct SpringPendulum<T = f64> {
    pub mass: T,
    pub gravity: T,
    pub l: T,
    pub stiffness: T,
}
impl Default for SpringPendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            gravity: 9.81,
            l: 1.0,
            stiffness: 1e6,
        }
    }
}
