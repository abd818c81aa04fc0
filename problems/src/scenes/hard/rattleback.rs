//! A rattleback: spun the wrong way it begins to rattle, stops, and turns back.

use lagrange_macros::Lagrangian;

/// The lower half of an ellipsoid rolls without slipping on a plane, its axes of inertia skewed to those of its shape.
///
/// (x, y, z) is its mass centre, `height` below the centre of the ellipsoid with semi-axes a, b, c. u is the vertical in
/// the body; the point of contact lies at −(a²u₁, b²u₂, c²u₃)/√(a²u₁² + b²u₂² + c²u₃²) from the centre. Five conditions on
/// seven coordinates, one of them of a quaternion.
///
/// What to expect: energy is conserved, and the spin changes sign (Walker 1896). Parameters from Kane & Levinson,
/// International Journal of Non-Linear Mechanics 17 (1982), without their damping.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", z: "m"),
    attitude(body: q),
    define(
        u = [body.axes[0][2], body.axes[1][2], body.axes[2][2]],
        support = sqrt(a^2 * u[0]^2 + b^2 * u[1]^2 + c^2 * u[2]^2),
        arm = -a^2 * u[0] / support * body.axes[0] - b^2 * u[1] / support * body.axes[1]
            + (height - c^2 * u[2] / support) * body.axes[2],
        turning = cross(body.space_rate, arm),
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2)
        + sum(k in 0..3: inertia[k]/2 * body.body_rate[k]^2) + skew * body.body_rate[0] * body.body_rate[1],
    potential = mass * gravity * z,
    constraint(floor: z == support - height * u[2]),
    constraint(rolling_x: der(x) + turning[0] == 0),
    constraint(rolling_y: der(y) + turning[1] == 0),
    start(spun: z = c - height, body.body_rate = (rock, 0, spin), der(y) = -rock * (c - height)),
    draw(floor: 0),
    draw(half_ellipsoid: (x, y, z) + height * body.axes[2], size = (a, b, c), attitude = body),
    draw(path: (x, y, z) + arm),
    draw(arrow: floor * (0, 0, 1) at (x, y, z) + arm),
    draw(arrow: (rolling_x, rolling_y, 0) at (x, y, z) + arm, name = rolling),
)]
pub struct Rattleback<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Moments of inertia about the ellipsoid's axes, kg m².
    #[lagrange(unit = "kg m^2", domain = "positive", symbol = "I")]
    pub inertia: [T; 3],
    /// Product of inertia I₀₁, kg m².
    #[lagrange(unit = "kg m^2")]
    pub skew: T,
    /// Semi-axis along, m.
    #[lagrange(unit = "m")]
    pub a: T,
    /// Semi-axis across, m.
    #[lagrange(unit = "m")]
    pub b: T,
    /// Semi-axis down, m.
    #[lagrange(unit = "m")]
    pub c: T,
    /// Height of the ellipsoid's centre above the mass centre, m.
    #[lagrange(unit = "m")]
    pub height: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Spin at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub spin: T,
    /// Rate of rocking about the long axis at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub rock: T,
}

impl Default for Rattleback {
    fn default() -> Self {
        Self {
            mass: 1.0,
            inertia: [2e-4, 1.6e-3, 1.7e-3],
            skew: -2e-5,
            a: 0.2,
            b: 0.03,
            c: 0.02,
            height: 0.01,
            gravity: 9.81,
            spin: -5.0,
            rock: 1.0,
        }
    }
}
