//! Declarations in, systems or mistakes out.

use super::System;
use crate::diagnostics::Diagnostics;

/// DESIGN's example.
pub(crate) const MASS_ON_WHEEL: &str = r#"
/// A small mass carried up and thrown off by the rim of a rolling wheel.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, phi, r: "m", theta),
    define(
        px = x + r * sin(theta),
        py = r * cos(theta),
    ),
    kinetic   = wheel/2 * der(x)^2 + inertia/2 * der(phi)^2 + mass/2 * (der(px)^2 + der(py)^2),
    potential = mass * gravity * py,
    constraint(rolling: der(x) == radius * der(phi)),
    contact(rim: r >= radius, restitution = 0),
    friction(grip on rim: slip = radius * (der(theta) - der(phi)), static = mu_static, kinetic = mu_kinetic),
    start(rest: r = radius, theta = 1/20),
    observe(height = py),
    stop(floor: py <= -radius and open(rim)),
)]
pub struct MassOnWheel<T = f64> {
    /// Mass of the wheel, kg.
    #[lagrange(unit = "kg", tex = "M")]
    pub wheel: T,
    pub inertia: T,
    pub mass: T,
    pub gravity: T,
    pub radius: T,
    pub mu_static: T,
    pub mu_kinetic: T,
}
"#;
