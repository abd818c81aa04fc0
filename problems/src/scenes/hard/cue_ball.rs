//! A billiard ball with side spin: its path bends, then it rolls.

use lagrange_macros::Lagrangian;

/// A ball slides on a level table with any spin.
///
/// What to expect (Coriolis 1835): the slip s = v − a ω × n keeps its direction whatever the spin, the friction is constant,
/// the path is a parabola. It rolls from 2|s₀|/(7 μ g) on, with v₀ − (2/7) s₀.
///
/// α and β are the integrals of the angular velocity about x and y: all that a ball needs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", z: "m", alpha: "rad", beta: "rad"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2) + mass * radius^2 / 5 * (der(alpha)^2 + der(beta)^2),
    potential = mass * gravity * z,
    contact(cloth: z >= radius),
    friction(grip on cloth:
        slip = (der(x) - radius * der(beta), der(y) + radius * der(alpha)), static = mu, kinetic = mu),
    start(struck: z = radius, der(x) = speed, der(alpha) = spin, der(beta) = follow),
    draw(floor: 0),
    draw(sphere: (x, y, z), radius = radius, rolled = (alpha, beta, 0)),
    draw(path: (x, y, z - radius)),
    draw(arrow: cloth * (0, 0, 1) at (x, y, z - radius)),
    draw(arrow: (grip[0], grip[1], 0) at (x, y, z - radius)),
)]
pub struct CueBall<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Coefficient of friction.
    #[lagrange(unit = "1", symbol = "mu")]
    pub mu: T,
    /// Speed at the start, m/s.
    #[lagrange(unit = "m/s", symbol = "v_0")]
    pub speed: T,
    /// Spin about the direction of the speed, rad/s.
    #[lagrange(unit = "rad/s")]
    pub spin: T,
    /// Spin about the horizontal across it, rad/s; speed/radius rolls.
    #[lagrange(unit = "rad/s")]
    pub follow: T,
}

impl Default for CueBall {
    fn default() -> Self {
        Self {
            mass: 0.17,
            radius: 0.028,
            gravity: 9.81,
            mu: 0.2,
            speed: 1.5,
            spin: -60.0,
            follow: -20.0,
        }
    }
}
