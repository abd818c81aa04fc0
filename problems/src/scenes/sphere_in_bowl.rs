//! A ball inside a hollow sphere: swings, slips, goes round, or falls off on the way.

use lagrange_macros::Lagrangian;

/// A solid sphere moves inside a fixed hollow sphere, in a vertical plane.
///
/// Here θ is counted from the **bottom**, counter-clockwise, and φ turns the same way: rolling to the right, the
/// sphere turns clockwise and φ falls. The bowl holds it from outside, `r <= radius - sphere_radius`.
///
/// What to expect while it rolls, with I = ⅖ m a²:
///
/// ```text
/// θ̈ = −(5/7) g sin θ / (R − a)        small swings: ω² = (5/7) g / (R − a)
/// N = (m g / 7) (17 cos θ − 10 cos θ₀)        from rest at θ₀;   |F| = (2/7) m g |sin θ|
/// ```
///
/// So from rest it rolls at once if tan θ₀ ≤ (7/2) μₛ (54.46° for μₛ = 0.4) and slips first if not: the start
/// `rest` (1.2 rad) slips, each swing a little less, until rolling is enough. The start `kicked` begins at the
/// bottom with the centre at `start_speed`; rolling all the way round needs v₀² ≥ (27/7) g (R − a), 5.502 m/s
/// with the defaults. With less it falls off above the height of the centre, or swings. Give a large friction
/// (`--set mu_static=10 --set mu_kinetic=10`) to see it never slip.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r: "m", theta: "rad", phi: "rad"),
    define(
        x = r * sin(theta),
        y = -r * cos(theta),
        inertia = 2/5 * mass * sphere_radius^2,
    ),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(bowl: r <= radius - sphere_radius),
    friction(grip on bowl:
        slip = (radius - sphere_radius) * der(theta) + sphere_radius * der(phi),
        static = mu_static, kinetic = mu_kinetic),
    start(rest: r = radius - sphere_radius, theta = start_angle),
    start(kicked:
        r = radius - sphere_radius,
        der(theta) = start_speed / (radius - sphere_radius),
        der(phi) = -start_speed / sphere_radius),
    observe(x, y),
    check(swings: der(der(theta)) == -5/7 * gravity * sin(theta) / (radius - sphere_radius) when sticks(grip)),
    check(needed: grip == 2/7 * mass * gravity * sin(theta) when sticks(grip)),
    check(from_rest: bowl == mass * gravity / 7 * (17*cos(theta) - 10*cos(start_angle))
        when sticks(grip) and energy == -mass * gravity * (radius - sphere_radius) * cos(start_angle)),
    // At the top it still presses if v₀² ≥ (27/7) g (R − a).
    check(from_kick: bowl == mass * start_speed^2/(radius - sphere_radius) + mass * gravity / 7 * (17*cos(theta) - 10)
        when sticks(grip) and energy == 7/10 * mass * start_speed^2 - mass * gravity * (radius - sphere_radius)),
    draw(bowl: (0, 0), radius = radius),
    draw(path: (x, y)),
    draw(disc: (x, y), radius = sphere_radius, angle = phi),
    draw(arrow: bowl * (-sin(theta), cos(theta)) at (r + sphere_radius) * (sin(theta), -cos(theta))),
    draw(arrow: grip * (cos(theta), sin(theta)) at (r + sphere_radius) * (sin(theta), -cos(theta))),
)]
pub struct SphereInBowl<T = f64> {
    /// Mass of the sphere, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Inner radius of the bowl, m.
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
    /// θ of the start `rest`, rad from the bottom.
    #[lagrange(unit = "rad", symbol = "theta_0")]
    pub start_angle: T,
    /// Speed of the centre in the start `kicked`, m/s.
    #[lagrange(unit = "m/s", symbol = "v_0")]
    pub start_speed: T,
}

impl Default for SphereInBowl {
    fn default() -> Self {
        Self {
            mass: 1.0,
            radius: 1.0,
            sphere_radius: 0.2,
            gravity: 9.81,
            mu_static: 0.4,
            mu_kinetic: 0.3,
            start_angle: 1.2,
            start_speed: 6.0,
        }
    }
}
