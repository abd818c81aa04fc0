//! A sled on three runners, one too many, slides and comes to rest.

use lagrange_macros::Lagrangian;

/// A block with three points that touch the floor in a row slides and is stopped by friction.
///
/// What each point carries is not determined, what they carry together is. Friction at the floor presses the front down,
///
/// ```text
/// Σ N = m g        Σ N b = μ h m g (b along the sled, h the height of its middle)
/// ẍ = −μ g         rests after v/(μ g), having slid v²/(2 μ g)
/// ```
///
/// With μ h between 2a/3 and a the forces of least norm would pull at the rear point; those of least norm that only push
/// are 0, m g (1 − μ h/a), m g μ h/a. At rest each point carries a third, and no friction acts.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, theta),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * gravity * y,
    contact(point[k in 0..3]: y + (k - 1) * span * sin(theta) - height * cos(theta) >= 0),
    friction(grip[k in 0..3] on point[k]:
        slip = der(x + (k - 1) * span * cos(theta) + height * sin(theta)), static = mu),
    start(sliding: y = height, der(x) = speed),
    draw(floor: 0),
    draw(polygon: (x - span * cos(theta) + height * sin(theta), y - span * sin(theta) - height * cos(theta))
        to (x + span * cos(theta) + height * sin(theta), y + span * sin(theta) - height * cos(theta))
        to (x, y) + span * (cos(theta), sin(theta)) to (x, y) - span * (cos(theta), sin(theta))),
    draw(mass: (x, y)),
    draw(arrow[k in 0..3]: point[k] * (0, 1)
        at (x, y) + (k - 1) * span * (cos(theta), sin(theta)) + height * (sin(theta), -cos(theta))),
    draw(arrow[k in 0..3]: grip[k] * (1, 0)
        at (x, y) + (k - 1) * span * (cos(theta), sin(theta)) + height * (sin(theta), -cos(theta))),
    emit = data,
)]
pub struct Sled<T = f64> {
    /// Mass, kg.
    pub mass: T,
    /// Moment of inertia about the middle, kg m².
    pub inertia: T,
    /// Distance a of neighbouring points, m.
    pub span: T,
    /// Height h of the middle above the floor, m.
    pub height: T,
    /// Gravitational acceleration, m/s².
    pub gravity: T,
    /// Coefficient of friction.
    pub mu: T,
    /// Speed v at the start, m/s.
    pub speed: T,
}

impl Default for Sled {
    fn default() -> Self {
        Self {
            mass: 3.0,
            inertia: 0.4,
            span: 0.5,
            height: 0.8,
            gravity: 9.81,
            mu: 0.5,
            speed: 2.0,
        }
    }
}
