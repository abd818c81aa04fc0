//! A bead on a wire hoop with friction: the wire pulls, then pushes.

use lagrange_macros::Lagrangian;

/// A bead slides on an upright wire hoop. Its friction is μ|N|, and N changes its sign where the bead would leave a groove.
///
/// What to expect for w = θ̇², θ from the bottom, N/(m r) = w + (g/r) cos θ and σ its sign:
///
/// ```text
/// dw/dθ + 2 σ μ w = −(2 g/r)(sin θ + σ μ cos θ)        w = C exp(−2 σ μ θ) + A cos θ + B sin θ
/// ```
///
/// while θ grows. It stops on its way back and stays where |tan θ| < μ.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r: "m", theta: "rad"),
    kinetic   = mass/2 * (der(r)^2 + r^2 * der(theta)^2),
    potential = -mass * gravity * r * cos(theta),
    constraint(wire: r == radius),
    friction(rub on wire: slip = radius * der(theta), static = mu, kinetic = mu),
    start(kicked: r = radius, der(theta) = rate),
    draw(bowl: (0, 0), radius = radius),
    draw(mass: r * (sin(theta), -cos(theta))),
    draw(arrow: wire * (sin(theta), -cos(theta)) at r * (sin(theta), -cos(theta))),
    draw(arrow: rub * (cos(theta), sin(theta)) at r * (sin(theta), -cos(theta))),
)]
pub struct HoopBead<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Radius of the hoop, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Coefficient of friction.
    #[lagrange(unit = "1", symbol = "mu")]
    pub mu: T,
    /// Angular velocity at the bottom at the start, rad/s.
    #[lagrange(unit = "rad/s", symbol = "omega")]
    pub rate: T,
}

impl Default for HoopBead {
    fn default() -> Self {
        Self {
            mass: 0.4,
            gravity: 9.81,
            radius: 0.8,
            mu: 0.2,
            rate: 7.0,
        }
    }
}
