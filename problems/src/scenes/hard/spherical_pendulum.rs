//! A spherical pendulum passes its pole, where its coordinates fail.

use crate::space::{Pose, Solid, Space, Vector};
use lagrange_core::prelude::*;

/// A pendulum on a sphere, by θ from the bottom and the azimuth φ, swings past the bottom at a tiny distance.
///
/// The angular momentum is conserved, so φ̇ is large near the pole: half a turn within a microsecond. What is lost there
/// is lost for good.
///
/// What to expect: each swing passes the bottom at the angle `nearest` and comes back to `amplitude`; its time and the
/// advance of the azimuth are elliptic integrals (Whittaker 1904, section 55).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta: "rad", phi: "rad"),
    kinetic   = mass/2 * length^2 * (der(theta)^2 + sin(theta)^2 * der(phi)^2),
    potential = -mass * gravity * length * cos(theta),
    start(turning:
        theta = amplitude,
        der(phi) = sin(nearest) / sin(amplitude) * sqrt(2 * gravity / length * (cos(nearest) - cos(amplitude))
            / (sin(amplitude)^2 - sin(nearest)^2))),
    start(pole: theta = 0, der(theta) = 1),
)]
pub struct SphericalPendulum<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Length, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Largest θ, rad.
    #[lagrange(unit = "rad")]
    pub amplitude: T,
    /// Smallest θ, rad.
    #[lagrange(unit = "rad")]
    pub nearest: T,
}

impl Default for SphericalPendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            amplitude: 1.0,
            nearest: 1e-6,
        }
    }
}

impl SphericalPendulum {
    /// The rod, the mass and its path, over the ground.
    pub fn drawing(&self, _t: f64, q: &[f64]) -> Space {
        let ((sin, cos), (across, along)) = (q[0].sin_cos(), q[1].sin_cos());
        let mass = self.length * Vector::new(sin * along, sin * across, -cos);
        Space::of([
            Solid::Ground(Pose::at(0.0, 0.0, -1.15 * self.length)),
            Solid::Pivot(Vector::zeros()),
            Solid::Rod(vec![Vector::zeros(), mass]),
            Solid::Mass(mass),
            Solid::Trace(mass),
        ])
    }
}
