//! A puck is pushed off by a force that turns: where its slip begins, and how.

use lagrange_macros::Lagrangian;

/// A puck rests on a table until a growing, turning force is stronger than friction; its slip begins in a direction that is part
/// of the answer, and turns from the first instant.
///
/// The force is made for a slip that is known: s = ρ u with ρ = jump t + growth t²/2 and u = (cos ωt, sin ωt) from t = 0
/// on needs m (ρ̇ + μₖ g) u + m ρ ω u⊥. With jump = 0 and equal coefficients the slip begins smoothly, as t², and the direction is
/// slaved to the force by an equation that is singular there; before t = 0 the same force holds it at rest.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", z: "m"),
    define(
        since = t - begin,
        rho = jump * since + growth * since^2 / 2,
        forward = mass * (jump + growth * since + mu_kinetic * gravity),
        sideways = mass * rho * turn,
        c = cos(turn * since),
        s = sin(turn * since),
    ),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    contact(table: z >= 0),
    friction(grip on table: slip = (der(x), der(y)), static = mu_static, kinetic = mu_kinetic),
    force(push: (forward * c - sideways * s, forward * s + sideways * c, 0) at (x, y, z)),
    start(lying: x = 0),
    // The puck is seen beside the way that it goes.
    define(wide = mu_kinetic * gravity * begin^2 / 20),
    draw(floor: 0),
    draw(disc: (x, y, z + wide/4), radius = wide, height = wide/2),
    draw(path: (x, y, z)),
    draw(arrow: push),
    draw(arrow: table * (0, 0, 1) at (x, y, z)),
    draw(arrow: (grip[0], grip[1], 0) at (x, y, z)),
)]
pub struct TurningPush<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Time at which the slip is made to begin, s.
    #[lagrange(unit = "s")]
    pub begin: T,
    /// Acceleration of the slip at first, m/s².
    #[lagrange(unit = "m/s^2")]
    pub jump: T,
    /// Rate at which it grows, m/s³.
    #[lagrange(unit = "m/s^3")]
    pub growth: T,
    /// Rate ω at which the slip turns, rad/s.
    #[lagrange(unit = "rad/s", symbol = "omega")]
    pub turn: T,
    /// Coefficient of static friction.
    #[lagrange(unit = "1", symbol = "mu_s")]
    pub mu_static: T,
    /// Coefficient of kinetic friction.
    #[lagrange(unit = "1", symbol = "mu_k")]
    pub mu_kinetic: T,
}

impl Default for TurningPush {
    fn default() -> Self {
        Self {
            mass: 0.7,
            gravity: 9.81,
            begin: 0.5,
            jump: 0.0,
            growth: 0.8,
            turn: 3.0,
            mu_static: 0.3,
            mu_kinetic: 0.3,
        }
    }
}
