//! A mass on a spring with dry friction swings a few times and stops, not at the middle.

use lagrange_macros::Lagrangian;

/// A block on a rough floor is pulled by a spring.
///
/// Each half swing takes π/ω and loses 2 μₖ m g/k of amplitude, until the block stops where the spring is weaker than
/// static friction: anywhere in the dead band |x| ≤ μₛ m g/k (Lorenz 1924; den Hartog 1931). There it has to stay: in a
/// program that smooths friction it creeps to the middle.
///
/// What to expect: turning points xₙ = (−1)ⁿ (x₀ − 2 n μₖ m g/k), at rest at the first that lies in the dead band.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential(weight: mass * gravity * y),
    potential(spring: stiffness/2 * x^2),
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x), static = mu_static, kinetic = mu_kinetic),
    start(stretched: x = amplitude),
    // The block is a tenth of the first swing wide.
    draw(floor: 0),
    draw(spring: (-2*amplitude, y + amplitude/10) to (x - amplitude/10, y + amplitude/10)),
    draw(box: (x, y + amplitude/10), size = (amplitude/5, amplitude/5)),
    draw(arrow: floor * (0, 1) at (x, y)),
    draw(arrow: grip * (1, 0) at (x, y)),
)]
pub struct CoulombOscillator<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Stiffness k of the spring, N/m.
    #[lagrange(unit = "N/m", symbol = "k")]
    pub stiffness: T,
    /// Coefficient of static friction.
    #[lagrange(unit = "1", symbol = "mu_s")]
    pub mu_static: T,
    /// Coefficient of kinetic friction.
    #[lagrange(unit = "1", symbol = "mu_k")]
    pub mu_kinetic: T,
    /// x₀, m.
    #[lagrange(unit = "m")]
    pub amplitude: T,
}

impl Default for CoulombOscillator {
    fn default() -> Self {
        Self {
            mass: 1.0,
            gravity: 9.81,
            stiffness: 20.0,
            mu_static: 0.3,
            mu_kinetic: 0.2,
            amplitude: 2.0,
        }
    }
}
