//! Two rods, one hung from the other: smooth, and chaotic.

use lagrange_macros::Lagrangian;

/// A double pendulum swings in a plane: two point masses on massless rods.
///
/// Both angles are counted from the downward vertical, counter-clockwise. Nothing happens in this scene but motion:
/// it is here to measure what accuracy costs, with `lagrange accuracy double-pendulum`.
///
/// What to expect: energy is conserved, and for large swings nothing else. Neighbouring motions part quickly: until
/// t = 5 s an error grows about a thousand times, so that double precision cannot give better than some 1e-13.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta1: "rad", theta2: "rad"),
    define(
        x1 = upper_length * sin(theta1),
        y1 = -upper_length * cos(theta1),
        x2 = x1 + lower_length * sin(theta2),
        y2 = y1 - lower_length * cos(theta2),
    ),
    kinetic   = upper_mass/2 * (der(x1)^2 + der(y1)^2) + lower_mass/2 * (der(x2)^2 + der(y2)^2),
    potential = gravity * (upper_mass * y1 + lower_mass * y2),
    start(rest: theta1 = upper_angle, theta2 = lower_angle),
    observe(x1, y1, x2, y2),
    draw(path: (x2, y2)),
    draw(rod: (0, 0) to (x1, y1) to (x2, y2)),
    draw(pivot: (0, 0)),
    draw(mass: (x1, y1)),
    draw(mass: (x2, y2)),
)]
pub struct DoublePendulum<T = f64> {
    /// The mass between the rods, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m_1")]
    pub upper_mass: T,
    /// The mass at the end, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m_2")]
    pub lower_mass: T,
    /// Length of the upper rod, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l_1")]
    pub upper_length: T,
    /// Length of the lower rod, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l_2")]
    pub lower_length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// θ₁ at the start, rad from the downward vertical.
    #[lagrange(unit = "rad", symbol = "alpha_1")]
    pub upper_angle: T,
    /// θ₂ at the start, rad from the downward vertical.
    #[lagrange(unit = "rad", symbol = "alpha_2")]
    pub lower_angle: T,
}

impl Default for DoublePendulum {
    fn default() -> Self {
        Self {
            upper_mass: 1.0,
            lower_mass: 1.0,
            upper_length: 1.0,
            lower_length: 1.0,
            gravity: 9.81,
            upper_angle: 2.0,
            lower_angle: 2.5,
        }
    }
}
