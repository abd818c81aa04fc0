//! A thrown ball bounces, grips the floor in one of its bounces, and rolls away.

use lagrange_macros::Lagrangian;

/// A solid ball with friction is thrown sideways, without spin, from a height.
///
/// Each bounce k arrives with the speed uₖ = eᵏ √(2gh) and takes the slip down by (7/2) μ (1 + e) uₖ, or all of what is
/// left if that is less: then the ball grips, in this bounce and in all that follow. If the bounces are not enough it
/// slides on the floor when it has come to rest on it, and rolls then.
///
/// What to expect: without spin at the start it rolls in the end with 5/7 of the speed it was thrown with, whatever
/// μ, e and the number of bounces are. The impacts accumulate at √(2h/g) (1 + e)/(1 − e) while the ball moves on.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", phi: "rad"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + (2/5 * mass * radius^2)/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(floor: y >= radius, restitution = bounce),
    friction(grip on floor: slip = der(x) - radius * der(phi), static = mu),
    start(thrown: y = radius + height, der(x) = speed),
    draw(floor: 0),
    draw(path: (x, y)),
    draw(disc: (x, y), radius = radius, angle = -phi),
    draw(arrow: floor * (0, 1) at (x, y - radius)),
    draw(arrow: grip * (1, 0) at (x, y - radius)),
)]
pub struct ThrownBall<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Restitution e.
    #[lagrange(unit = "1")]
    pub bounce: T,
    /// Coefficient of friction, static and kinetic.
    #[lagrange(unit = "1")]
    pub mu: T,
    /// Height of the lowest point at the start, m.
    #[lagrange(unit = "m")]
    pub height: T,
    /// Speed at the start, m/s.
    #[lagrange(unit = "m/s")]
    pub speed: T,
}

impl Default for ThrownBall {
    fn default() -> Self {
        Self {
            mass: 0.5,
            radius: 0.1,
            gravity: 9.81,
            bounce: 0.5,
            mu: 0.1,
            height: 1.0,
            speed: 4.0,
        }
    }
}
