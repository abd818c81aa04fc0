//! A mass on a spring with dry friction swings a few times and stops, not at the middle.

use crate::drawing::{Drawing, Shape};
use lagrange_core::prelude::*;

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

impl CoulombOscillator {
    /// The floor, the spring and the block, a tenth of the first swing wide.
    pub fn drawing(&self, _t: f64, q: &[f64]) -> Drawing {
        let (x, y) = (q[0], q[1]);
        let half = 0.1 * self.amplitude;
        Drawing::of([
            Shape::Floor(0.0),
            Shape::Spring([-2.0 * self.amplitude, y + half], [x - half, y + half]),
            Shape::Block(vec![
                [x - half, y],
                [x + half, y],
                [x + half, y + 2.0 * half],
                [x - half, y + 2.0 * half],
            ]),
        ])
        .force("floor", [x, y], [0.0, 1.0])
        .force("grip", [x, y], [1.0, 0.0])
    }
}
