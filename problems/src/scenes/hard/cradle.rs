//! Newton's cradle: one ball hits two that touch.

use lagrange_macros::Lagrangian;

/// Three equal balls on a line, the second and third touching, struck by the first.
///
/// Momentum and restitution in each contact do not say what happens: it depends on whether the contacts act together
/// or in turn. Here they act together, with Newton's law in each (Glocker 2001, chapter 6): with e = 1 and the speed v
///
/// ```text
/// speeds after: −v/3, 2v/3, 2v/3        momentum and energy as before
/// ```
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3]: "m"),
    kinetic = sum(k in 0..3: mass/2 * der(x[k])^2),
    contact(pair[k in 0..2]: x[k+1] - x[k] >= 2 * radius, restitution = bounce),
    start(struck: x[0] = -4 * radius, x[1] = 0, x[2] = 2 * radius, der(x[0]) = speed),
    draw(disc[k in 0..3]: (x[k], 0), radius = radius),
)]
pub struct Cradle<T = f64> {
    /// Mass of each ball, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius of each ball, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Restitution e.
    #[lagrange(unit = "1", symbol = "e")]
    pub bounce: T,
    /// Speed of the first ball, m/s.
    #[lagrange(unit = "m/s")]
    pub speed: T,
}

impl Default for Cradle {
    fn default() -> Self {
        Self {
            mass: 0.1,
            radius: 0.02,
            bounce: 1.0,
            speed: 1.0,
        }
    }
}
