//! A real ball on a sphere: it rolls, slips, and only then leaves.

use lagrange_macros::Lagrangian;

/// A solid sphere rolls down a fixed spherical shell, begins to slip, leaves and falls.
///
/// The same sphere as [`RollingSphere`](super::RollingSphere), but now the force that keeps it rolling is Coulomb
/// friction: while it sticks, |F| ≤ μₛ N; once that is not enough it slips, and F = −μₖ N along the slip.
/// `slip` is the velocity of the sphere's contact point over the shell, so that `slip = 0` is rolling.
///
/// What to expect: rolling needs (2/7) m g sin θ and N falls, so slip comes first, always, where
///
/// ```text
/// (2/7) sin θ = (μₛ/7) (17 cos θ − 10 cos θ₀)        39.26° for μₛ = 0.4 from θ₀ = 0.01
/// ```
///
/// After that u = θ̇² obeys du/dθ − 2 μₖ u = 2 g/(R + a) · (sin θ − μₖ cos θ), linear with constant coefficients,
/// and the sphere leaves where N = m g cos θ − m (R + a) u = 0. In flight φ̇ stays what it was: φ and θ are no
/// longer tied.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r: "m", theta: "rad", phi: "rad"),
    define(
        x = r * sin(theta),
        y = r * cos(theta),
        inertia = 2/5 * mass * sphere_radius^2,
    ),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(shell: r >= radius + sphere_radius),
    friction(grip on shell:
        slip = radius * der(theta) - sphere_radius * (der(phi) - der(theta)),
        static = mu_static, kinetic = mu_kinetic),
    start(rest: r = radius + sphere_radius, theta = start_angle),
    observe(x, y),
    stop(floor: y <= -radius),
    check(rolls: der(der(theta)) == 5/7 * gravity * sin(theta) / (radius + sphere_radius) when sticks(grip)),
    check(needed: grip == -2/7 * mass * gravity * sin(theta) when sticks(grip)),
    check(normal: shell == mass * gravity / 7 * (17*cos(theta) - 10*cos(start_angle))
        when sticks(grip) and energy == mass * gravity * (radius + sphere_radius) * cos(start_angle)),
    // du/dθ = 2 θ̈
    check(slides: 2*der(der(theta)) - 2*mu_kinetic * der(theta)^2
        == 2*gravity/(radius + sphere_radius) * (sin(theta) - mu_kinetic * cos(theta))
        when slips(grip) and slip(grip) >= 0),
    check(leaves: shell == mass * gravity * cos(theta) - mass * (radius + sphere_radius) * der(theta)^2
        when closed(shell)),
    check(spin: conserved der(phi) when open(shell)),
    draw(floor: -radius - sphere_radius),
    draw(shell: (0, 0), radius = radius),
    draw(path: (x, y)),
    draw(disc: (x, y), radius = sphere_radius, angle = -phi),
    draw(arrow: shell * (sin(theta), cos(theta)) at (r - sphere_radius) * (sin(theta), cos(theta))),
    draw(arrow: grip * (cos(theta), -sin(theta)) at (r - sphere_radius) * (sin(theta), cos(theta))),
)]
pub struct RollingSlippingSphere<T = f64> {
    /// Mass of the sphere, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius of the shell, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Radius of the sphere, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "a")]
    pub sphere_radius: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Coefficient of static friction.
    #[lagrange(unit = "1", symbol = "mu_s")]
    pub mu_static: T,
    /// Coefficient of kinetic friction.
    #[lagrange(unit = "1", symbol = "mu_k")]
    pub mu_kinetic: T,
    /// θ at the start, rad from the upward vertical.
    #[lagrange(unit = "rad", symbol = "theta_0")]
    pub start_angle: T,
}

impl Default for RollingSlippingSphere {
    fn default() -> Self {
        Self {
            mass: 1.0,
            radius: 1.0,
            sphere_radius: 0.2,
            gravity: 9.81,
            mu_static: 0.4,
            mu_kinetic: 0.3,
            start_angle: 0.01,
        }
    }
}
