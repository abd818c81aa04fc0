//! A block on a moving belt, held by a spring: it sticks and slips for ever.

use lagrange_macros::Lagrangian;

/// A block rides on a belt until its spring is stronger than static friction, slides back, and is caught again.
///
/// What to expect, with ω² = k/m, the stretches at slip s₁ = μₛ m g/k and s̄ = μₖ m g/k, and belt speed v: it slides for
///
/// ```text
/// τ = 2 (π − atan(ω (s₁ − s̄)/v))/ω        from s₁ to 2 s̄ − s₁, then rides for 2 (s₁ − s̄)/v
/// ```
///
/// (den Hartog, Mechanical Vibrations, 1956, section 7.6). The error of every catch and every slip adds up in the
/// time of the last one.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s: "m", n: "m"),
    kinetic   = mass/2 * (der(s)^2 + der(n)^2),
    potential(weight: mass * gravity * n),
    potential(spring: stiffness/2 * s^2),
    contact(belt: n >= 0),
    friction(grip on belt: slip = der(s) - speed, static = mu_static, kinetic = mu_kinetic),
    start(riding: der(s) = speed),
    // The block is as large as a third of what friction can stretch.
    define(edge = 3/10 * mu_static * mass * gravity / stiffness),
    draw(floor: 0),
    draw(spring: (-10*edge, n + edge/2) to (s, n + edge/2)),
    draw(box: (s + edge/2, n + edge/2), size = (edge, edge)),
    draw(arrow: belt * (0, 1) at (s + edge/2, n)),
    draw(arrow: grip * (1, 0) at (s + edge/2, n)),
)]
pub struct BeltOscillator<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Stiffness k of the spring, N/m.
    #[lagrange(unit = "N/m", symbol = "k")]
    pub stiffness: T,
    /// Speed of the belt, m/s.
    #[lagrange(unit = "m/s")]
    pub speed: T,
    /// Coefficient of static friction.
    #[lagrange(unit = "1", symbol = "mu_s")]
    pub mu_static: T,
    /// Coefficient of kinetic friction.
    #[lagrange(unit = "1", symbol = "mu_k")]
    pub mu_kinetic: T,
}

impl Default for BeltOscillator {
    fn default() -> Self {
        Self {
            mass: 1.5,
            gravity: 9.81,
            stiffness: 40.0,
            speed: 0.2,
            mu_static: 0.5,
            mu_kinetic: 0.3,
        }
    }
}
