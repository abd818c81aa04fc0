//! A thin disk rolls on the floor, leans over almost flat, and comes up again.

use lagrange_macros::Lagrangian;

/// A uniform thin disk rolls without slipping on a horizontal plane.
///
/// (x, y) is the point of contact, φ the heading, θ the angle of the disk's plane to the floor (½π upright), ψ its
/// turn. Two conditions on velocities that no condition on positions can replace. Close to the floor it turns round
/// fast.
///
/// What to expect: energy is conserved; upright in a circle it stays (Routh 1884); in general, with the components ω₁
/// along the heading, ω₂ up the disk's plane and ω₃ along its axle,
///
/// ```text
/// (A + mR²) ω̇₁ = A ω₂² cot θ − (C + mR²) ω₂ ω₃ − m g R cos θ
/// A ω̇₂ = (C ω₃ − A ω₂ cot θ) ω₁        (C + mR²) ω̇₃ = mR² ω₁ ω₂
/// ```
///
/// (Appell 1900; Neimark & Fufaev 1972).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", phi: "rad", theta: "rad", psi: "rad"),
    define(
        cx = x - radius * cos(theta) * sin(phi),
        cy = y + radius * cos(theta) * cos(phi),
        cz = radius * sin(theta),
    ),
    kinetic = mass/2 * (der(cx)^2 + der(cy)^2 + der(cz)^2)
        + mass * radius^2 / 8 * (der(theta)^2 + sin(theta)^2 * der(phi)^2)
        + mass * radius^2 / 4 * (der(psi) + cos(theta) * der(phi))^2,
    potential = mass * gravity * cz,
    constraint(rolling_x: der(x) == -radius * cos(phi) * der(psi)),
    constraint(rolling_y: der(y) == -radius * sin(phi) * der(psi)),
    start(leaning:
        theta = start_angle, der(phi) = turn, der(psi) = spin, der(x) = -radius * spin),
    draw(floor: 0),
    draw(disc: (cx, cy, cz), radius = radius, turn = ((0, 0, phi), (theta, 0, 0), (0, 0, psi))),
    draw(path: (x, y, 0)),
    draw(arrow: (rolling_x, rolling_y, 0) at (x, y, 0), name = rolling),
)]
pub struct RollingDisk<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius R, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// θ at the start, rad from the floor.
    #[lagrange(unit = "rad")]
    pub start_angle: T,
    /// φ̇ at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub turn: T,
    /// ψ̇ at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub spin: T,
}

impl Default for RollingDisk {
    fn default() -> Self {
        Self {
            mass: 1.0,
            radius: 0.1,
            gravity: 9.81,
            start_angle: 1.0,
            turn: 1.0,
            spin: 2.0,
        }
    }
}
