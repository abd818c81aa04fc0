//! A pendulum whose rod is a very stiff spring: two time scales.

use lagrange_macros::Lagrangian;

/// A point mass swings on a spring so stiff that it is almost a rod.
///
/// r is the length of the spring, θ its angle from the downward vertical. The spring begins at its natural length, and
/// the weight sets it ringing at √(k/m): 159 times a second with the defaults, some micrometres wide. Nothing damps
/// that, so whoever wants accuracy has to follow every oscillation.
///
/// What to expect: energy is conserved; without gravity (`--set gravity=0`) the angular momentum m r² θ̇ too.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r: "m", theta: "rad"),
    define(
        x = r * sin(theta),
        y = -r * cos(theta),
    ),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential(weight: mass * gravity * y),
    potential(spring: stiffness/2 * (r - length)^2),
    start(rest: r = length, theta = start_angle),
    observe(x, y),
    draw(path: (x, y)),
    draw(spring: (0, 0) to (x, y)),
    draw(pivot: (0, 0)),
    draw(mass: (x, y)),
)]
pub struct StiffSpringPendulum<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Natural length of the spring, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Stiffness of the spring, N/m.
    #[lagrange(unit = "N/m", symbol = "k")]
    pub stiffness: T,
    /// θ at the start, rad from the downward vertical.
    #[lagrange(unit = "rad")]
    pub start_angle: T,
}

impl Default for StiffSpringPendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            stiffness: 1e6,
            start_angle: 1.0,
        }
    }
}
