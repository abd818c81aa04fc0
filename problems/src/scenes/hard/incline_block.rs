//! A block slides sideways on an incline: its slip turns downhill and stops on the way, or never.

use lagrange_macros::Lagrangian;

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
    // Places on the plane, and a block that is seen beside the way that it goes, which is of the order of v₀²/g.
    define(
        across = [0, cos(slope), -sin(slope)],
        up = [0, sin(slope), cos(slope)],
        place = [x, 0, 0] + y * across + z * up,
        edge = speed^2 / (10 * gravity),
    ),
    draw(floor: 0, turn = (-slope, 0, 0)),
    draw(box: place + 3/10 * edge * up, size = (edge, edge, 3/5 * edge), turn = (-slope, 0, 0)),
    draw(path: place),
    draw(arrow: plane * up at place),
    draw(arrow: (grip[0], 0, 0) + grip[1] * across at place),
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
