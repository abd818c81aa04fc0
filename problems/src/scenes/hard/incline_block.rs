//! A block slides sideways on an incline: its slip turns downhill and stops on the way, or never.

use crate::space::{Pose, Solid, Space, Vector};
use lagrange_core::prelude::*;

/// A block is pushed across an incline; the friction turns with the slip.
///
/// What to expect, with a = g sin α, n = μ/tan α and ψ the angle of the velocity from downhill: v̇ = a (cos ψ − n) and
/// v ψ̇ = −a sin ψ, so that v = v₀ tanⁿ(½ψ)/sin ψ. For n > 1 it stops after
///
/// ```text
/// T = n v₀/(a (n² − 1))        across v₀²/(2a) (1/(2n−1) + 1/(2n+1))        down v₀²/(4a) (1/(2n−2) − 1/(2n+2))
/// ```
///
/// Close to the end ψ ~ (T − t)^(1/(n−1)): the direction turns ever faster for n > 2, and |slip| has no change of sign. For
/// n = 1 it never stops: v (1 + cos ψ) = v₀.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", z: "m"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * (z * cos(slope) - y * sin(slope)),
    contact(plane: z >= 0),
    friction(grip on plane: slip = (der(x), der(y)), static = mu, kinetic = mu),
    start(pushed: der(x) = speed),
)]
pub struct InclineBlock<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Angle of the incline, rad.
    #[lagrange(unit = "rad", symbol = "alpha")]
    pub slope: T,
    /// Coefficient of friction.
    #[lagrange(unit = "1", symbol = "mu")]
    pub mu: T,
    /// Speed across at the start, m/s.
    #[lagrange(unit = "m/s", symbol = "v_0")]
    pub speed: T,
}

impl Default for InclineBlock {
    fn default() -> Self {
        Self {
            mass: 1.0,
            gravity: 9.81,
            slope: 0.3,
            mu: 2.0 * 0.3_f64.tan(),
            speed: 1.5,
        }
    }
}

impl InclineBlock {
    /// The block on the incline and its path.
    pub fn drawing(&self, _t: f64, q: &[f64]) -> Space {
        let plane = Pose::at(0.0, 0.0, 0.0).turned(Vector::x(), -self.slope);
        let (along, across, up) = (
            plane.turn * Vector::x(),
            plane.turn * Vector::y(),
            plane.turn * Vector::z(),
        );
        // Large enough to be seen beside the way that it goes, which is of the order of v₀²/g.
        let edge = 0.1 * self.speed * self.speed / self.gravity;
        let touching = plane.moved(q[0], q[1], q[2]);
        Space::of([
            Solid::Ground(plane),
            Solid::Box(
                [edge, edge, 0.6 * edge],
                touching.moved(0.0, 0.0, 0.3 * edge),
            ),
            Solid::Trace(touching.at),
        ])
        .force("plane", touching.at, [("plane", up)])
        .force(
            "grip",
            touching.at,
            [("grip[0]", along), ("grip[1]", across)],
        )
    }
}
