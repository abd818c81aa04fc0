//! A pendulum in Cartesian coordinates: the plainest problem of index 3.

use crate::closed_form::pendulum;
use lagrange_core::prelude::State;
use lagrange_macros::Lagrangian;
use lagrange_program::closed_form::ClosedForm;

/// A point mass swings on a massless rod, described by x and y alone: the rod is a constraint.
///
/// Its multiplier belongs to x² + y² = l², so that the tension of the rod is −2 l λ newtons. The program knows the
/// motion in closed form; see [`CartesianPendulum::closed_form`].
///
/// What to expect, with θ from the downward vertical and k² = (v²/2 + g (y + l)) / (2 g l):
///
/// ```text
/// sin(θ/2) = k sn(√(g/l) t + u₀ | k²)        swings for k < 1, goes round for k > 1
/// ```
///
/// Of rounding and truncation, only what moves the mass along its circle stays: x² + y² = l² is kept after each step.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x^2 + y^2 == length^2),
    start(level: x = length),
    start(kicked: y = -length, der(x) = start_speed),
    draw(rod: (0, 0) to (x, y)),
    draw(pivot: (0, 0)),
    draw(mass: (x, y)),
    // The gradient of x² + y².
    draw(arrow: 2*rod * (x, y) at (x, y)),
)]
pub struct CartesianPendulum<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Length of the rod, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Speed at the bottom in the start `kicked`, m/s.
    #[lagrange(unit = "m/s", symbol = "v_0")]
    pub start_speed: T,
}

impl Default for CartesianPendulum {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            start_speed: 7.0,
        }
    }
}

impl CartesianPendulum {
    /// The state at time `until` by Jacobi's elliptic functions; none for the motion that ends at the top.
    pub fn closed_form(&self, start: &State<f64>, until: f64) -> Option<ClosedForm> {
        pendulum::swing(self.length, self.gravity, start, until)
    }
}
