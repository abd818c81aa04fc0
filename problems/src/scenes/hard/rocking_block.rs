//! A block rocks from corner to corner, ever faster, until it stands.

use lagrange_macros::Lagrangian;

/// A slender block rocks on its two lower corners, which do not slip.
///
/// Each time it is upright the other corner strikes without restitution and the block goes on about that one: moment of momentum
/// about it is kept, which leaves the share 1 − (3/2) sin²α of the rate, tan α = half width over half height (Housner 1963).
/// The swings between get shorter in the same measure: infinitely many in finite time, alternating between two contacts.
///
/// What to expect, leaving the upright position at the rate ω about a corner at distance R, p² = (3/4) g/R:
///
/// ```text
/// greatest tilt m: 4 p² sin(α − m/2) sin(m/2) = ω²        time of the swing: quadrature of 1/θ̇ from 0 to m and back
/// ```
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + mass * (half_width^2 + half_height^2)/6 * der(theta)^2,
    potential = mass * gravity * y,
    define(
        left_x = x - half_width * cos(theta) + half_height * sin(theta),
        left_y = y - half_width * sin(theta) - half_height * cos(theta),
        right_x = x + half_width * cos(theta) + half_height * sin(theta),
        right_y = y + half_width * sin(theta) - half_height * cos(theta),
    ),
    contact(left: left_y >= 0),
    contact(right: right_y >= 0),
    friction(left_grip on left: slip = der(left_x), static = mu),
    friction(right_grip on right: slip = der(right_x), static = mu),
    start(rocking: y = half_height, der(x) = -half_height * rate, der(y) = half_width * rate, der(theta) = rate),
    draw(floor: 0),
    draw(box: (x, y), size = (2*half_width, 2*half_height), angle = theta),
    draw(arrow: left * (0, 1) at (left_x, left_y)),
    draw(arrow: left_grip * (1, 0) at (left_x, left_y)),
    draw(arrow: right * (0, 1) at (right_x, right_y)),
    draw(arrow: right_grip * (1, 0) at (right_x, right_y)),
    emit = data,
)]
pub struct RockingBlock<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Half the width, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "b")]
    pub half_width: T,
    /// Half the height, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "h")]
    pub half_height: T,
    /// Coefficient of friction, static and kinetic: large enough never to slip.
    #[lagrange(unit = "1")]
    pub mu: T,
    /// Rate at the start, upright and about the left corner, rad/s.
    #[lagrange(unit = "rad/s")]
    pub rate: T,
}

impl Default for RockingBlock {
    fn default() -> Self {
        Self {
            mass: 3.0,
            gravity: 9.81,
            half_width: 0.2,
            half_height: 0.8,
            mu: 5.0,
            rate: 0.3,
        }
    }
}
