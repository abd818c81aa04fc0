//! A block rocks from corner to corner, ever less and ever faster, until it stands.

use lagrange_core::prelude::*;

/// A rectangular block, tilted onto one of its lower corners and let go.
///
/// Each time it stands upright the other corner hits the floor; both contacts have a part in the impact, and one of them
/// opens at once. With half the width b, half the height h, R² = b² + h² and tan α = b/h (Housner 1963):
///
/// ```text
/// while it rocks      θ̈ = −(3g/4R) sin(α − |θ|)
/// at each impact      θ̇⁺ = (1 − ³⁄₂ sin²α) θ̇⁻
/// ```
///
/// so that the swings shrink geometrically and there are infinitely many before it stands.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + mass * (half_width^2 + half_height^2) / 6 * der(theta)^2,
    potential = mass * gravity * y,
    contact(left: y - half_width * sin(theta) >= half_height * cos(theta)),
    contact(right: y + half_width * sin(theta) >= half_height * cos(theta)),
    friction(left_grip on left:
        slip = der(x - half_width * cos(theta) + half_height * sin(theta)), static = mu),
    friction(right_grip on right:
        slip = der(x + half_width * cos(theta) + half_height * sin(theta)), static = mu),
    start(tilted:
        x = half_width * cos(start_angle) - half_height * sin(start_angle),
        y = half_width * sin(start_angle) + half_height * cos(start_angle),
        theta = start_angle),
)]
pub struct RockingBlock<T = f64> {
    /// Mass, kg.
    pub mass: T,
    /// Half the width b, m.
    pub half_width: T,
    /// Half the height h, m.
    pub half_height: T,
    /// Gravitational acceleration, m/s².
    pub gravity: T,
    /// Coefficient of friction, static and kinetic; large enough that no corner ever slips.
    pub mu: T,
    /// θ at the start, rad, onto the left corner.
    pub start_angle: T,
}

impl Default for RockingBlock {
    fn default() -> Self {
        Self {
            mass: 100.0,
            half_width: 0.25,
            half_height: 1.0,
            gravity: 9.81,
            mu: 2.0,
            start_angle: 0.1,
        }
    }
}
