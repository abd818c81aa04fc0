//! A ball that bounces infinitely often in finite time.

use lagrange_macros::Lagrangian;

/// A ball falls, bounces ever lower, and comes to rest.
///
/// Each impact leaves the share e of the speed, so the times between impacts shrink like eᵏ: there are infinitely
/// many before the ball rests (Brogliato 2016, section 1.3). A program that follows them one by one never gets
/// there; one that stops at a smallest interval stops too early.
///
/// What to expect, dropped from h:
///
/// ```text
/// first impact t₁ = √(2h/g)        at rest at t₁ (1 + e)/(1 − e)
/// ```
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y: "m"),
    kinetic   = mass/2 * der(y)^2,
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    start(dropped: y = height),
    draw(floor: 0),
    draw(mass: (0, y)),
    draw(arrow: floor * (0, 1) at (0, y)),
)]
pub struct BouncingBall<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Restitution e: speed after an impact over speed before.
    #[lagrange(unit = "1")]
    pub bounce: T,
    /// Height at the start, m.
    #[lagrange(unit = "m")]
    pub height: T,
}

impl Default for BouncingBall {
    fn default() -> Self {
        Self {
            mass: 1.0,
            gravity: 9.81,
            bounce: 0.9,
            height: 1.0,
        }
    }
}
