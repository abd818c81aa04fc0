//! Painlevé's rod: rigid friction with one answer, with two, and with none.

use lagrange_macros::Lagrangian;

/// A rod slides with its tip on a rough floor, leaning away from the direction it slides in: chalk pushed over a board.
///
/// θ is the angle from the floor, (x, y) the middle, l half the length; the tip is at (x − l cos θ, y − l sin θ) and
/// slides to the left. The acceleration of its gap is A N + b with
///
/// ```text
/// A = (1 + 3 cos θ (cos θ − μ sin θ))/m        b = l θ̇² sin θ − g
/// ```
///
/// (Painlevé 1895; Génot & Brogliato 1999). A > 0, b < 0: it slides, N = −b/A. A < 0, b > 0: it may fly or stay, both with
/// N ≥ 0. A < 0, b < 0: neither, with any N; a rigid floor has no answer.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + mass * half^2 / 6 * der(theta)^2,
    potential = mass * gravity * y,
    contact(tip: y >= half * sin(theta)),
    friction(grip on tip: slip = der(x) + half * sin(theta) * der(theta), static = mu),
    start(sliding:
        x = half * cos(start_angle), y = half * sin(start_angle), theta = start_angle,
        der(theta) = rate, der(y) = half * cos(start_angle) * rate,
        der(x) = -speed - half * sin(start_angle) * rate),
    stop(flat: theta <= 0),
    draw(floor: 0),
    draw(rod: (x, y) - half * (cos(theta), sin(theta)) to (x, y) + half * (cos(theta), sin(theta))),
    draw(arrow: tip * (0, 1) at (x, y) - half * (cos(theta), sin(theta))),
    draw(arrow: grip * (1, 0) at (x, y) - half * (cos(theta), sin(theta))),
)]
pub struct PainleveRod<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Half the length, m.
    #[lagrange(unit = "m", domain = "positive")]
    pub half: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Coefficient of friction, static and kinetic.
    #[lagrange(unit = "1")]
    pub mu: T,
    /// θ at the start, rad from the floor.
    #[lagrange(unit = "rad")]
    pub start_angle: T,
    /// θ̇ at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub rate: T,
    /// Speed of the tip to the left at the start, m/s.
    #[lagrange(unit = "m/s")]
    pub speed: T,
}

impl Default for PainleveRod {
    fn default() -> Self {
        Self {
            mass: 1.0,
            half: 0.5,
            gravity: 9.81,
            mu: 0.5,
            start_angle: 1.1,
            rate: 0.0,
            speed: 1.0,
        }
    }
}
