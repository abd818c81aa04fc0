//! A pendulum on a string goes slack, flies, and is caught.

use lagrange_macros::Lagrangian;

/// A mass on an inextensible string is kicked so that it rises above the support, but not all the way.
///
/// The string only pulls: it is the one-sided contact √(x² + y²) ≤ l. With 2 < v₀²/(g l) < 5 it goes slack at the
/// height l sin α above the support,
///
/// ```text
/// sin α = (v₀²/(g l) − 2)/3        speed² = g l sin α
/// ```
///
/// flies on a parabola and is caught after the time 4 v cos α/g, at the angle −3α seen from the other side (a
/// parabola that osculates a circle meets it again there). The pull along the string is lost, the rest swings on.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(string: sqrt(x^2 + y^2) <= length),
    start(kicked: y = -length, der(x) = speed),
    draw(path: (x, y)),
    draw(rope: (0, 0) to (x, y)),
    draw(pivot: (0, 0)),
    draw(mass: (x, y)),
    draw(arrow: -string / sqrt(x^2 + y^2) * (x, y) at (x, y)),
)]
pub struct StringPendulum<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Length l of the string, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Speed v₀ at the bottom, m/s.
    #[lagrange(unit = "m/s")]
    pub speed: T,
}

impl Default for StringPendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            speed: 5.5,
        }
    }
}
