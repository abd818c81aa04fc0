use lagrange_core::prelude::*;

/// A ball bounces and rolls down an incline.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", phi: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass * radius^2/5 * der(phi)^2,
    potential = mass * gravity * (y * cos(slope) - x * sin(slope)),
    contact(incline: y >= radius, restitution = bounce),
    friction(grip on incline: slip = der(x) - radius * der(phi), static = mu),
    start(dropped: y = radius + height),
    define(down = [cos(slope), -sin(slope)], up = [sin(slope), cos(slope)], centre = x * down + y * up),
    draw(ground: (0, 0) to 40 * height * down to (0, -40 * height * sin(slope))),
    draw(path: centre),
    draw(disc: centre, radius = radius, angle = -slope - phi),
)]
pub struct RollingBall<T = f64> {
    #[lagrange(unit = "kg")]
    pub mass: T,
    #[lagrange(unit = "m")]
    pub radius: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "rad")]
    pub slope: T,
    pub mu: T,
    pub bounce: T,
    #[lagrange(unit = "m")]
    pub height: T,
}

impl Default for RollingBall {
    fn default() -> Self {
        Self {
            mass: 0.2,
            radius: 0.05,
            gravity: 9.81,
            slope: 0.2,
            mu: 0.4,
            bounce: 0.6,
            height: 0.3,
        }
    }
}
