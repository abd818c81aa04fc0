//! The cradle as one sees it: blows are passed on, one after the other.

use lagrange_macros::Lagrangian;

/// Five equal balls on a line; one, two or three of them strike the others, which touch.
///
/// Solved in turn, each blow by itself, momentum and energy are passed on from pair to pair, again and again until none
/// approaches: as many balls leave as have come, with their speed. Solved together (`Simulation::impacts`, or
/// `--impacts together`), the struck balls move off as one.
///
/// ```text
/// speeds after, n released at speed v: 0 for the first 5 − n, v for the last n        (in turn, e = 1)
///                                      −3v/5, 2v/5, 2v/5, 2v/5, 2v/5                   (together, e = 1, n = 1)
/// ```
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[5]: "m"),
    kinetic = sum(k in 0..5: mass/2 * der(x[k])^2),
    contact(pair[k in 0..4]: x[k+1] - x[k] >= 2 * radius, restitution = bounce),
    impacts = in_turn,
    start(one: x[0] = -4 * radius, x[2] = 2 * radius, x[3] = 4 * radius, x[4] = 6 * radius, der(x[0]) = speed),
    start(two: x[0] = -6 * radius, x[1] = -4 * radius, x[3] = 2 * radius, x[4] = 4 * radius,
        der(x[0]) = speed, der(x[1]) = speed),
    start(three: x[0] = -8 * radius, x[1] = -6 * radius, x[2] = -4 * radius, x[4] = 2 * radius,
        der(x[0]) = speed, der(x[1]) = speed, der(x[2]) = speed),
    draw(disc[k in 0..5]: (x[k], 0), radius = radius),
)]
pub struct FiveBallCradle<T = f64> {
    /// Mass of each ball, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius of each ball, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Restitution e.
    #[lagrange(unit = "1")]
    pub bounce: T,
    /// Speed of those released, m/s.
    #[lagrange(unit = "m/s", symbol = "v")]
    pub speed: T,
}

impl Default for FiveBallCradle {
    fn default() -> Self {
        Self {
            mass: 0.1,
            radius: 0.02,
            bounce: 1.0,
            speed: 1.0,
        }
    }
}
