//! A spherical pendulum passes its pole, where its coordinates fail.

use lagrange_macros::Lagrangian;

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
    draw(floor: -23/20*length),
    draw(pivot: (0, 0, 0)),
    draw(rod: (0, 0, 0) to length * (sin(theta)*cos(phi), sin(theta)*sin(phi), -cos(theta))),
    draw(mass: length * (sin(theta)*cos(phi), sin(theta)*sin(phi), -cos(theta))),
    draw(path: length * (sin(theta)*cos(phi), sin(theta)*sin(phi), -cos(theta))),
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
