//! A pendulum in Cartesian coordinates, for a hundred thousand periods.

use lagrange_macros::Lagrangian;

/// A mass on a rod: the rod is a condition on x and y, not a coordinate.
///
/// Differentiated twice, the condition no longer holds by itself: without projection its residual grows like t², with
/// a careless one the energy drifts.
///
/// What to expect: the rod keeps its length to rounding, the energy its value, and the period is
/// 2π √(l/g)/agm(1, cos ½θ₀) (Gauss).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x^2 + y^2 == length^2),
    start(raised: x = length * sin(start_angle), y = -length * cos(start_angle)),
    draw(rod: (0, 0) to (x, y)),
    draw(pivot: (0, 0)),
    draw(mass: (x, y)),
    // The gradient of x² + y².
    draw(arrow: 2*rod * (x, y) at (x, y)),
)]
pub struct LongPendulum<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Length l, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Angle θ₀ at the start, rad from the bottom.
    #[lagrange(unit = "rad")]
    pub start_angle: T,
}

impl Default for LongPendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            start_angle: 1.0,
        }
    }
}
