//! A double pendulum whose masses differ by eight powers of ten.

use lagrange_macros::Lagrangian;

/// A double pendulum with a heavy and a light mass.
///
/// With the heavy mass below, the light one between is whipped about at √(heavy/light) times the rate of the swing;
/// with the heavy one above, the mass matrix is nearly singular all the same.
///
/// What to expect: with the heavy mass above, it swings as if the light one were not there, up to light/heavy; with the
/// heavy mass below and the links aligned, both swing as one pendulum of the whole length.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[2]: "rad"),
    define(
        x[k in 0..2] = sum(i in 0..k+1: length[i] * sin(theta[i])),
        y[k in 0..2] = sum(i in 0..k+1: -length[i] * cos(theta[i])),
    ),
    kinetic   = sum(k in 0..2: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..2: mass[k] * gravity * y[k]),
    start(raised: theta[0] = start_angle, theta[1] = lower_angle),
    draw(path: (x[1], y[1])),
    draw(rod: (0, 0) to list(k in 0..2: (x[k], y[k]))),
    draw(pivot: (0, 0)),
    draw(mass[k in 0..2]: (x[k], y[k])),
)]
pub struct UnequalPendulum<T = f64> {
    /// The masses, upper and lower, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: [T; 2],
    /// Lengths of the links, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: [T; 2],
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Angle of the upper link at the start, rad from the downward vertical.
    #[lagrange(unit = "rad")]
    pub start_angle: T,
    /// Angle of the lower link at the start, rad from the downward vertical.
    #[lagrange(unit = "rad")]
    pub lower_angle: T,
}

impl Default for UnequalPendulum {
    fn default() -> Self {
        Self {
            mass: [1e8, 1.0],
            length: [1.0, 0.7],
            gravity: 9.81,
            start_angle: 1.0,
            lower_angle: 0.5,
        }
    }
}
