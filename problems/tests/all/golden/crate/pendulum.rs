use lagrange_core::prelude::*;

/// A pendulum: a mass on a massless rod swings in a plane.
///
/// Lines like these describe the system. Items follow, with commas between them; their order does not matter.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    // The angle from the downward vertical.
    coordinates(theta: "rad"),

    // Names for expressions: where the mass is.
    define(
        x = length * sin(theta),
        y = -length * cos(theta),
    ),

    // The energies. `der` is the derivative with respect to time.
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,

    // What takes energy away, by Rayleigh's function R: the torque is −∂R/∂(der(theta)).
    dissipation(bearing: damping/2 * der(theta)^2),

    // Where a run begins (`--from NAME`; the first start is the default). What is not named is 0.
    start(released: theta = 2),
    start(pushed: der(theta) = 5),

    // What is written beside the coordinates.
    observe(x, y),

    // What a picture shows (`lagrange report FILE`), from the back to the front.
    draw(path: (x, y)),
    draw(rod: (0, 0) to (x, y)),
    draw(pivot: (0, 0)),
    draw(mass: (x, y)),

    // What is logged whenever it happens.
    mark(lowest: theta),
)]
pub struct Pendulum<T = f64> {
    /// The mass at the end of the rod.
    #[lagrange(unit = "kg")]
    pub mass: T,
    /// Length of the rod.
    #[lagrange(unit = "m")]
    pub length: T,
    /// Gravitational acceleration.
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    /// Friction in the bearing.
    #[lagrange(unit = "N m s")]
    pub damping: T,
}

impl Default for Pendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            damping: 0.05,
        }
    }
}
