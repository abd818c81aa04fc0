//! A rod on two supports is pulled until it slides, and tips over the one ahead.

use lagrange_macros::Lagrangian;

/// A rod lies on two edges; a force that grows with time pulls it along.
///
/// The normal forces follow from balance, the two friction forces do not: only their sum is determined. Sliding begins
/// when no friction in both cones can hold the rod, that is at F = μₛ m g, although the edge that carries less could by
/// itself hold less than half of it. As the rod slides its weight moves over the front edge,
///
/// ```text
/// N(left) = m g (b − x)/(a + b)        N(right) = m g (a + x)/(a + b)
/// m ẍ = r t − μₖ m g                   until x = b, where the rod lifts off the left edge and tips
/// ```
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    define(sliding = der(x) * cos(theta) + der(y) * sin(theta)),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + mass * length^2 / 24 * der(theta)^2,
    potential = mass * gravity * y,
    contact(left: y * cos(theta) - (x + back) * sin(theta) >= 0),
    contact(right: y * cos(theta) - (x - front) * sin(theta) >= 0),
    friction(left_grip on left: slip = sliding, static = mu_static, kinetic = mu_kinetic),
    friction(right_grip on right: slip = sliding, static = mu_static, kinetic = mu_kinetic),
    force(pull: x = rate * t),
    start(resting: x = 0),
    stop(tipped: theta <= -1/10),
    draw(ground: (-back, 0) to (-back + 3/125*length, -3/50*length) to (-back - 3/125*length, -3/50*length)),
    draw(ground: (front, 0) to (front + 3/125*length, -3/50*length) to (front - 3/125*length, -3/50*length)),
    draw(rod: (x, y) - length/2 * (cos(theta), sin(theta)) to (x, y) + length/2 * (cos(theta), sin(theta))),
    draw(mass: (x, y)),
    draw(arrow: left * (-sin(theta), cos(theta)) at (-back, 0)),
    draw(arrow: left_grip * (cos(theta), sin(theta)) at (-back, 0)),
    draw(arrow: right * (-sin(theta), cos(theta)) at (front, 0)),
    draw(arrow: right_grip * (cos(theta), sin(theta)) at (front, 0)),
    emit = data,
)]
pub struct RodOnSupports<T = f64> {
    /// Mass, kg.
    pub mass: T,
    /// Length, m.
    pub length: T,
    /// Gravitational acceleration, m/s².
    pub gravity: T,
    /// Distance a of the left edge behind the middle at the start, m.
    pub back: T,
    /// Distance b of the right edge before the middle at the start, m.
    pub front: T,
    /// Growth r of the pull, N/s.
    pub rate: T,
    /// Coefficient of static friction.
    pub mu_static: T,
    /// Coefficient of kinetic friction.
    pub mu_kinetic: T,
}

impl Default for RodOnSupports {
    fn default() -> Self {
        Self {
            mass: 2.0,
            length: 3.0,
            gravity: 9.81,
            back: 0.6,
            front: 0.4,
            rate: 3.0,
            mu_static: 0.4,
            mu_kinetic: 0.3,
        }
    }
}
