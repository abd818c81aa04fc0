//! A mass rides on a wheel that is free to roll away under it.

use lagrange_macros::Lagrangian;

/// A small mass carried up and thrown off by the rim of a rolling wheel.
///
/// The wheel rolls on the floor (x is its centre, φ its turn, clockwise as it moves to the right); the mass sits
/// on its rim at r and θ, seen from the centre and measured from the upward vertical. Stuck to the rim, it turns the
/// wheel, which rolls to the side where the mass goes down: what the rim must give depends on both motions.
///
/// What to expect: the mass sticks to the rim until grip is not enough, slips over it, and is thrown
/// off; the wheel then rolls on with constant speed. While stuck the system has one degree of freedom, and
/// energy gives θ̇ in closed form. After that no closed form is known.
///
/// With large kinetic friction the rigid rim has no answer at all (Painlevé 1895): above μₖ ≈ 6.35 a slipping
/// mass can neither stay on nor leave, and the run ends with an error that says so.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", phi: "rad", r: "m", theta: "rad"),
    define(
        px = x + r * sin(theta),
        py = r * cos(theta),
    ),
    kinetic   = wheel/2 * der(x)^2 + inertia/2 * der(phi)^2 + mass/2 * (der(px)^2 + der(py)^2),
    potential = mass * gravity * py,
    constraint(rolling: der(x) == radius * der(phi)),
    contact(rim: r >= radius, restitution = 0),
    friction(grip on rim: slip = radius * (der(theta) - der(phi)), static = mu_static, kinetic = mu_kinetic),
    start(rest: r = radius, theta = start_angle),
    observe(px, py),
    stop(floor: py <= -radius),
    check(stuck: der(der(theta)) * (wheel*radius^2 + inertia + 2*mass*radius^2*(1 + cos(theta)))
        == mass * radius * sin(theta) * (gravity + radius * der(theta)^2) when sticks(grip)),
    check(normal: rim == mass * (gravity*cos(theta) - radius*der(theta)^2 + der(der(x))*sin(theta)) when closed(rim)),
    check(pushed: (wheel + inertia/radius^2) * der(der(x)) == -rim*sin(theta) - grip*(1 + cos(theta)) when closed(rim)),
    // Where the factor of N vanishes, rigid friction has no answer.
    check(slipping: rim * (wheel + inertia/radius^2 + mass*sin(theta) * (sin(theta) - mu_kinetic*(1 + cos(theta))))
        == mass * (wheel + inertia/radius^2) * (gravity*cos(theta) - radius*der(theta)^2)
        when slips(grip) and slip(grip) >= 0),
    check(thrown: conserved der(px) when open(rim)),
    draw(floor: -radius),
    draw(disc: (x, 0), radius = radius, angle = -phi),
    draw(path: (px, py)),
    draw(mass: (px, py)),
    draw(arrow: rolling * (1, 0) at (x, -radius)),
    draw(arrow: rim * (sin(theta), cos(theta)) at (px, py)),
    draw(arrow: grip * (cos(theta), -sin(theta)) at (px, py)),
)]
pub struct MassOnWheel<T = f64> {
    /// Mass of the wheel, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "M")]
    pub wheel: T,
    /// Moment of inertia of the wheel about its centre, kg m²; ½ M R² for a disc.
    #[lagrange(unit = "kg m^2", domain = "positive", symbol = "I")]
    pub inertia: T,
    /// The small mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius of the wheel, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
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

impl Default for MassOnWheel {
    fn default() -> Self {
        Self {
            wheel: 1.0,
            inertia: 0.125,
            mass: 0.2,
            radius: 0.5,
            gravity: 9.81,
            mu_static: 0.6,
            mu_kinetic: 0.5,
            start_angle: 0.05,
        }
    }
}
