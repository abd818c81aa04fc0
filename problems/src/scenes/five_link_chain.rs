//! A hanging chain, written once for any number of links.

use lagrange_macros::Lagrangian;

/// A chain of five links swings in a plane: point masses at the ends of massless rods.
///
/// The coordinates are an array, the angle of each link from the downward vertical, counter-clockwise. A chain of
/// another length is the same declaration with another number.
///
/// What to expect: energy is conserved; without gravity (`--set gravity=0`) the angular momentum about the pivot too.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[5]: "rad"),
    define(
        x[k in 0..5] = sum(i in 0..k+1: length * sin(theta[i])),
        y[k in 0..5] = sum(i in 0..k+1: -length * cos(theta[i])),
    ),
    kinetic   = sum(k in 0..5: mass/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..5: mass * gravity * y[k]),
    start(bent: theta[k in 0..5] = start_angle[k]),
    observe(tip_x = x[4], tip_y = y[4]),
    draw(path: (x[4], y[4])),
    draw(rod: (0, 0) to list(k in 0..5: (x[k], y[k]))),
    draw(pivot: (0, 0)),
    draw(mass[k in 0..5]: (x[k], y[k])),
)]
pub struct FiveLinkChain<T = f64> {
    /// Mass at the end of each link, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Length of each link, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Angle of a link at the start, rad from the downward vertical.
    #[lagrange(unit = "rad", symbol = "alpha")]
    pub start_angle: [T; 5],
}

impl Default for FiveLinkChain {
    fn default() -> Self {
        Self {
            mass: 1.0,
            length: 1.0,
            gravity: 9.81,
            start_angle: [0.5, 0.7, 0.9, 1.1, 1.3],
        }
    }
}
