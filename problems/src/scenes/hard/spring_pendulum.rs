//! A pendulum on a very stiff spring: two time scales ten thousand apart.

use lagrange_macros::Lagrangian;

/// A mass swings on a spring so stiff that it hardly stretches, and rings at √(k/m).
///
/// The slow swing has to come out right through thousands of periods of the fast one.
///
/// What to expect: energy is conserved; the swing is that of a rigid pendulum but for terms of the order m g/(k l).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r: "m", theta: "rad"),
    kinetic   = mass/2 * (der(r)^2 + r^2 * der(theta)^2),
    potential(weight: -mass * gravity * r * cos(theta)),
    potential(spring: stiffness/2 * (r - length)^2),
    start(held: r = length, theta = start_angle),
    draw(path: r * (sin(theta), -cos(theta))),
    draw(spring: (0, 0) to r * (sin(theta), -cos(theta))),
    draw(pivot: (0, 0)),
    draw(mass: r * (sin(theta), -cos(theta))),
)]
pub struct SpringPendulum<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Length l of the relaxed spring, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Stiffness k, N/m.
    #[lagrange(unit = "N/m", symbol = "k")]
    pub stiffness: T,
    /// θ at the start, rad from the bottom.
    #[lagrange(unit = "rad")]
    pub start_angle: T,
}

impl Default for SpringPendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            stiffness: 1e8,
            start_angle: 1.0,
        }
    }
}
