//! A puck is pushed off by a force that turns: where its slip begins, and how.

use crate::space::{Pose, Solid, Space, Vector};
use lagrange_core::prelude::*;

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

impl TurningPush {
    /// The puck on the table, its path, and what pushes it.
    pub fn drawing(&self, t: f64, q: &[f64]) -> Space {
        let puck = Pose::at(q[0], q[1], q[2]);
        // Large enough to be seen beside the way that it goes in a second.
        let radius = 0.05 * (self.jump + self.growth);
        let height = 0.5 * radius;
        let since = t - self.begin;
        let rho = self.jump * since + self.growth * since * since / 2.0;
        let forward = self.jump + self.growth * since + self.mu_kinetic * self.gravity;
        let turned = puck.turned(Vector::z(), self.turn * since);
        let push = turned.turn * Vector::new(forward, rho * self.turn, 0.0) * self.mass;
        Space::of([
            Solid::Ground(Pose::at(0.0, 0.0, 0.0)),
            Solid::Disc(radius, height, puck.moved(0.0, 0.0, height / 2.0)),
            Solid::Trace(puck.at),
        ])
        .applied("push", puck.at, push)
        .force("table", puck.at, [("table", Vector::z())])
        .force(
            "grip",
            puck.at,
            [("grip[0]", Vector::x()), ("grip[1]", Vector::y())],
        )
    }
}
