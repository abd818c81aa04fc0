use lagrange_core::prelude::*;

/// A rod falls and strikes the floor with one end.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    define(
        left = [x, y] - length/2 * [cos(theta), sin(theta)],
        right = [x, y] + length/2 * [cos(theta), sin(theta)],
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass * length^2/24 * der(theta)^2,
    potential = mass * gravity * y,
    contact(a: left[1] >= 0, restitution = bounce),
    contact(b: right[1] >= 0, restitution = bounce),
    start(dropped: y = height, theta = tilt),
    draw(floor: 0), draw(rod: left to right),
)]
pub struct FallingRod<T = f64> {
    #[lagrange(unit = "kg")]
    pub mass: T,
    #[lagrange(unit = "m")]
    pub length: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "rad")]
    pub tilt: T,
    #[lagrange(unit = "m")]
    pub height: T,
    pub bounce: T,
}

impl Default for FallingRod {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            tilt: 0.5,
            height: 1.0,
            bounce: 0.5,
        }
    }
}
