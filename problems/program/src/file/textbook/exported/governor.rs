use lagrange_core::prelude::*;

/// Watt's governor: two balls on arms, a sleeve, a driven shaft.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta: "rad", phi: "rad"),
    define(height = -2 * arm * cos(theta)),
    kinetic = shaft/2 * der(phi)^2 + ball * arm^2 * (der(theta)^2 + sin(theta)^2 * der(phi)^2) + sleeve/2 * der(height)^2,
    potential = -2 * ball * gravity * arm * cos(theta) + sleeve * gravity * height,
    dissipation(dashpot: damping/2 * der(height)^2),
    constraint(drive: der(phi) == rate),
    contact(stop_low: theta >= 0.1),
    start(down: theta = 0.1, der(phi) = rate),
    observe(height),
    define(side = arm * sin(theta) * [cos(phi), sin(phi), 0], drop = [0, 0, -arm * cos(theta)]),
    draw(rod: (0, 0, 0) to (0, 0, -2 * arm)),
    draw(rod: (0, 0, 0) to drop + side to 2 * drop to drop - side to (0, 0, 0)),
    draw(sphere: drop + side, radius = arm/6), draw(sphere: drop - side, radius = arm/6),
    draw(disc: 2 * drop, radius = arm/8, height = arm/6, turn = (0, 0, phi)),
)]
pub struct Governor<T = f64> {
    #[lagrange(unit = "kg")]
    pub ball: T,
    #[lagrange(unit = "m")]
    pub arm: T,
    #[lagrange(unit = "kg")]
    pub sleeve: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "kg m^2")]
    pub shaft: T,
    #[lagrange(unit = "N s/m")]
    pub damping: T,
    #[lagrange(unit = "rad/s")]
    pub rate: T,
}

impl Default for Governor {
    fn default() -> Self {
        Self {
            ball: 0.5,
            arm: 0.2,
            sleeve: 1.0,
            gravity: 9.81,
            shaft: 0.1,
            damping: 2.0,
            rate: 15.0,
        }
    }
}
