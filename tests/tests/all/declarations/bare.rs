//! A derive in a module without the standard prelude, whose names mean something else, and on a struct that nobody should use any more.

#![no_implicit_prelude]

use ::core::clone::Clone;
use ::core::fmt::Debug;
use ::lagrange_core::Lagrangian;

#[allow(dead_code)]
struct Some;
#[allow(dead_code)]
struct None;

/// A block on springs above a rough floor.
#[deprecated]
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, turn[2]),
    define(tip = [x + arm*sin(turn[0]), y - arm*cos(turn[0])]),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + arm^2*(der(turn[0])^2 + der(turn[1])^2)),
    potential = mass*gravity*y + stiffness/2*min(x, 0)^2,
    contact(floor: y >= 0, restitution = bounce),
    friction(grip on floor: slip = der(x), static = mu),
    force(push: x = strength*sin(t)),
    dissipation(oil: der(turn[1])^2/2),
    observe(tip, speed = der(x)),
    stop(far: x >= arm),
    mark(middle: turn[0]),
    start(rest: y = arm),
    draw(mass: tip),
    draw(arrow: floor*(0, 1) at tip),
)]
pub struct Bare {
    pub mass: f64,
    pub arm: f64,
    pub gravity: f64,
    pub stiffness: f64,
    pub bounce: f64,
    pub mu: f64,
    pub strength: f64,
}
