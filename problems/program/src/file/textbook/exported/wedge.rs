use lagrange_core::prelude::*;

/// A mass slides down a wedge that slides on the floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s: "m", x: "m", y: "m"),
    define(height = (x - s) * sin(slope) + y * cos(slope)),
    kinetic = wedge/2 * der(s)^2 + mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(face: (x - s) * sin(slope) + y * cos(slope) >= 0),
    friction(rub on face: slip = (der(x) - der(s)) * cos(slope) - der(y) * sin(slope), static = mu),
    start(top),
    stop(bottom: y <= -length * sin(slope)),
    draw(floor: -length * sin(slope)),
    draw(polygon: (s, 0) to (s + length * cos(slope), -length * sin(slope)) to (s, -length * sin(slope))),
    draw(path: (x, y)), draw(mass: (x, y)),
    draw(arrow: face * (sin(slope), cos(slope)) at (x, y)),
)]
pub struct Wedge<T = f64> {
    #[lagrange(unit = "kg")]
    pub mass: T,
    #[lagrange(unit = "kg")]
    pub wedge: T,
    #[lagrange(unit = "rad")]
    pub slope: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    pub mu: T,
    #[lagrange(unit = "m")]
    pub length: T,
}

impl Default for Wedge {
    fn default() -> Self {
        Self {
            mass: 1.0,
            wedge: 3.0,
            slope: 0.5,
            gravity: 9.81,
            mu: 0.0,
            length: 1.0,
        }
    }
}
