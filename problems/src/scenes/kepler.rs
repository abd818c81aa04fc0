//! A planet on an eccentric orbit.

use crate::closed_form::orbit;
use lagrange_core::prelude::State;
use lagrange_macros::Lagrangian;
use lagrange_program::closed_form::ClosedForm;

/// A body of unit mass orbits a fixed centre that attracts it with μ/r².
///
/// An orbit of eccentricity 0.9 is slow far out and nineteen times faster at the pericentre, where the program begins:
/// a method that cannot change its step has no chance. The program knows the motion in closed form; see
/// [`Kepler::closed_form`].
///
/// What to expect: after each period 2π √(a³/μ) the body is back where it was (the default is a hundred of them).
/// Energy −μ/2a, angular momentum, and the vector from the centre to the pericentre (Laplace, Runge, Lenz) are
/// conserved.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic   = 1/2 * (der(x)^2 + der(y)^2),
    potential = -attraction / sqrt(x^2 + y^2),
    start(pericentre:
        x = semi_major_axis * (1 - eccentricity),
        der(y) = sqrt(attraction / semi_major_axis * (1 + eccentricity) / (1 - eccentricity))),
    draw(shell: (0, 0), radius = semi_major_axis/20),
    draw(path: (x, y)),
    draw(mass: (x, y)),
)]
pub struct Kepler<T = f64> {
    /// μ, m³/s².
    #[lagrange(unit = "m^3/s^2", symbol = "mu")]
    pub attraction: T,
    /// a, half the long axis of the orbit, m.
    #[lagrange(unit = "m", symbol = "a")]
    pub semi_major_axis: T,
    /// Eccentricity of the orbit, at least 0 and below 1.
    #[lagrange(unit = "1", symbol = "e")]
    pub eccentricity: T,
}

impl Default for Kepler {
    fn default() -> Self {
        Self {
            attraction: 1.0,
            semi_major_axis: 1.0,
            eccentricity: 0.9,
        }
    }
}

impl Kepler {
    /// The state at time `until` by Kepler's equation; none for orbits that do not close.
    pub fn closed_form(&self, start: &State<f64>, until: f64) -> Option<ClosedForm> {
        orbit::elliptic(self.attraction, start, until)
    }
}
