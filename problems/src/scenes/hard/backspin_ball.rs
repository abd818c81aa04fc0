//! A ball with backspin slides, turns round and rolls back.

use lagrange_macros::Lagrangian;

/// A solid ball is set down on the floor with a speed forward and a spin backward.
///
/// While it slips, friction slows the ball and its spin; when the slip has gone it rolls, here backward, and the force
/// of friction jumps from μ m g to nothing. A program that smooths the jump creeps or chatters there.
///
/// What to expect, with the slip s₀ = v₀ + a ω₀ at the start (Coriolis 1835):
///
/// ```text
/// rolls from t = 2 s₀/(7 μ g) on        v = v₀ − (2/7) s₀ = (5 v₀ − 2 a ω₀)/7
/// ```
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", phi: "rad"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + (2/5 * mass * radius^2)/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(floor: y >= radius),
    friction(grip on floor: slip = der(x) - radius * der(phi), static = mu),
    start(struck: y = radius, der(x) = speed, der(phi) = -spin),
    draw(floor: 0),
    draw(path: (x, y)),
    draw(disc: (x, y), radius = radius, angle = -phi),
    draw(arrow: floor * (0, 1) at (x, y - radius)),
    draw(arrow: grip * (1, 0) at (x, y - radius)),
)]
pub struct BackspinBall<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius a, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Coefficient of friction, static and kinetic.
    #[lagrange(unit = "1")]
    pub mu: T,
    /// Speed v₀ at the start, m/s.
    #[lagrange(unit = "m/s")]
    pub speed: T,
    /// Backspin ω₀ at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub spin: T,
}

impl Default for BackspinBall {
    fn default() -> Self {
        Self {
            mass: 0.17,
            radius: 0.028,
            gravity: 9.81,
            mu: 0.2,
            speed: 1.0,
            spin: 150.0,
        }
    }
}
