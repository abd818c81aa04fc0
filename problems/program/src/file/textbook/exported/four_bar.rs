use lagrange_core::prelude::*;

/// A four-bar linkage: crank, coupler, rocker, which move in their own weight.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a: "rad", b: "rad", c: "rad"),
    define(
        pin = [crank * cos(a), crank * sin(a)],
        joint = pin + [coupler * cos(b), coupler * sin(b)],
        other = [ground + rocker * cos(c), rocker * sin(c)],
        mid = pin + [coupler/2 * cos(b), coupler/2 * sin(b)],
    ),
    kinetic(crank_bar: density * crank^3/6 * der(a)^2),
    kinetic(coupler_bar: density * coupler/2 * dot(der(mid), der(mid)) + density * coupler^3/24 * der(b)^2),
    kinetic(rocker_bar: density * rocker^3/6 * der(c)^2),
    potential = density * gravity * (crank * pin[1]/2 + coupler * mid[1] + rocker * other[1]/2),
    constraint(closed_x: joint[0] == other[0]),
    constraint(closed_y: joint[1] == other[1]),
    // With the crank along the ground the other bars are the sides of a triangle.
    start(turning: b = acos(2/3), c = pi - acos(1/9), der(a) = rate, der(b) = -rate/3, der(c) = -rate/3),
    draw(pivot: [0, 0]), draw(pivot: [ground, 0]),
    draw(rod: [0, 0] to pin to joint to [ground, 0]),
    draw(path: mid),
)]
pub struct FourBar<T = f64> {
    #[lagrange(unit = "m")]
    pub crank: T,
    #[lagrange(unit = "m")]
    pub coupler: T,
    #[lagrange(unit = "m")]
    pub rocker: T,
    #[lagrange(unit = "m")]
    pub ground: T,
    #[lagrange(unit = "kg/m")]
    pub density: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "rad/s")]
    pub rate: T,
}

impl Default for FourBar {
    fn default() -> Self {
        Self {
            crank: 0.1,
            coupler: 0.4,
            rocker: 0.3,
            ground: 0.4,
            density: 2.0,
            gravity: 9.81,
            rate: 12.0,
        }
    }
}
