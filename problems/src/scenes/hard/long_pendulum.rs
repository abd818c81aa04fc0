//! A pendulum in Cartesian coordinates, for a hundred thousand periods.

use crate::drawing::{Drawing, Shape};
use lagrange_core::prelude::*;

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

impl LongPendulum {
    /// The rod and the mass.
    pub fn drawing(&self, _t: f64, q: &[f64]) -> Drawing {
        let mass = [q[0], q[1]];
        Drawing::of([
            Shape::Rod(vec![[0.0; 2], mass]),
            Shape::Pivot([0.0; 2]),
            Shape::Mass(mass),
        ])
        // The gradient of x² + y².
        .force("rod", mass, [2.0 * q[0], 2.0 * q[1]])
    }
}
