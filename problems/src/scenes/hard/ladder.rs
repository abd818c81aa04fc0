//! A ladder slides down a wall: where does it leave it?

use lagrange_macros::Lagrangian;

/// A uniform ladder slides from rest, without friction, along a wall and a floor.
///
/// θ is its angle from the floor; x and y are its middle. Both ends are one-sided contacts. The wall pushes less and
/// less and at last not at all; a program that keeps the ladder on the wall goes on with a wall that pulls.
///
/// What to expect (Lamb, Dynamics, 1914): θ̇² = (3g/l)(sin θ₀ − sin θ), the wall is left at
///
/// ```text
/// sin θ = ⅔ sin θ₀        ẋ = ½ √(g l sin θ₀) · ⅔ sin θ₀        from there on constant
/// ```
///
/// and the upper end meets the floor with the angular velocity that energy gives.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + mass * length^2 / 24 * der(theta)^2,
    potential = mass * gravity * y,
    contact(wall: x >= length/2 * cos(theta)),
    contact(floor: y >= length/2 * sin(theta)),
    start(leaning:
        x = length/2 * cos(start_angle),
        y = length/2 * sin(start_angle),
        theta = start_angle),
    stop(flat: theta <= 0),
    draw(floor: 0),
    draw(ground: (-length/20, 0) to (0, 0) to (0, 11/10*length) to (-length/20, 11/10*length)),
    draw(rod: (x - length/2 * cos(theta), y + length/2 * sin(theta)) to (x + length/2 * cos(theta), y - length/2 * sin(theta))),
    draw(arrow: wall * (1, 0) at (x - length/2 * cos(theta), y + length/2 * sin(theta))),
    draw(arrow: floor * (0, 1) at (x + length/2 * cos(theta), y - length/2 * sin(theta))),
)]
pub struct Ladder<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Length l, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// θ at the start, rad from the floor.
    #[lagrange(unit = "rad")]
    pub start_angle: T,
}

impl Default for Ladder {
    fn default() -> Self {
        Self {
            mass: 10.0,
            length: 4.0,
            gravity: 9.81,
            start_angle: 1.2,
        }
    }
}
