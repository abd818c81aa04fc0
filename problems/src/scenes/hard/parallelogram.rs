//! A beam on three parallel cranks, one of them too many, turns through its dead positions.

use lagrange_macros::Lagrangian;

/// A heavy beam on three equal parallel cranks: a locomotive's coupling rod.
///
/// Three conditions for three coordinates, and yet it moves: one crank is redundant, always. Where the cranks lie along
/// the beam, twice a turn, the conditions lose one more rank: with two cranks alone the linkage could turn over there.
/// The forces of the cranks are not determined; what moves the beam is.
///
/// What to expect: the beam does not turn, and its middle is a pendulum of the crank's length.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", psi: "rad"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(psi)^2,
    potential = mass * gravity * y,
    constraint(crank[k in 0..3]:
        (x + (k - 1) * span * (cos(psi) - 1))^2 + (y + (k - 1) * span * sin(psi))^2 == length^2),
    start(spun: y = -length, der(x) = speed),
    draw(rod[k in 0..3]: ((k - 1) * span, 0) to (x, y) + (k - 1) * span * (cos(psi), sin(psi))),
    draw(rod: (x, y) - span * (cos(psi), sin(psi)) to (x, y) + span * (cos(psi), sin(psi))),
    draw(mass: (x, y)),
    emit = data,
)]
pub struct Parallelogram<T = f64> {
    /// Mass of the beam, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Moment of inertia of the beam about its middle, kg m².
    #[lagrange(unit = "kg m^2", domain = "positive", symbol = "I")]
    pub inertia: T,
    /// Distance of neighbouring cranks, m.
    #[lagrange(unit = "m")]
    pub span: T,
    /// Length of the cranks, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Speed at the bottom, m/s; goes round if above √(4 g l).
    #[lagrange(unit = "m/s")]
    pub speed: T,
}

impl Default for Parallelogram {
    fn default() -> Self {
        Self {
            mass: 1.0,
            inertia: 0.1,
            span: 0.5,
            length: 0.3,
            gravity: 9.81,
            speed: 4.0,
        }
    }
}
