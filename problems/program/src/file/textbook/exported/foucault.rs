use lagrange_core::prelude::*;

/// Foucault's pendulum, in the frame of the Earth, small swings.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass * earth * sin(latitude) * (x * der(y) - y * der(x)),
    potential = mass * gravity/(2 * length) * (x^2 + y^2),
    start(released: x = amplitude),
    mark(turning: der(x)),
)]
pub struct Foucault<T = f64> {
    #[lagrange(unit = "m")]
    pub length: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "rad/s")]
    pub earth: T,
    #[lagrange(unit = "rad")]
    pub latitude: T,
    #[lagrange(unit = "kg")]
    pub mass: T,
    #[lagrange(unit = "m")]
    pub amplitude: T,
}

impl Default for Foucault {
    fn default() -> Self {
        Self {
            length: 67.0,
            gravity: 9.81,
            earth: 7.292e-5,
            latitude: 0.853,
            mass: 28.0,
            amplitude: 3.0,
        }
    }
}
