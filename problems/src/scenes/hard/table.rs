//! A table on four legs is pushed until it slides.

use lagrange_macros::Lagrangian;

/// A table stands on four legs on a rough floor; a force that grows with time pushes it.
///
/// What each leg carries, and how its friction points, is not determined while the table stands. It stands as long as *some*
/// forces in the cones of the legs balance the push. The push acts at the floor, through the middle, in direction β: then
/// all legs slip together as soon as it reaches μₛ m g, whatever each of them carries, and the table moves straight on,
///
/// ```text
/// Σ N = m g        m s̈ = r t − μₖ m g        from t = μₛ m g/r on
/// ```
///
/// It could also turn about a leg that alone carries half of the weight: as nobody knows what the legs carry, nobody knows that it
/// does not. The event is flagged `ambiguous`; all four legs go on carrying.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, psi, z, pitch, roll),
    define(a = length/2, b = width/2),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2)
        + inertia/2 * (der(psi)^2 + der(pitch)^2 + der(roll)^2),
    potential = mass * gravity * z,
    contact(fore_left:  z + a * pitch + b * roll >= 0),
    contact(fore_right: z + a * pitch - b * roll >= 0),
    contact(rear_left:  z - a * pitch + b * roll >= 0),
    contact(rear_right: z - a * pitch - b * roll >= 0),
    friction(grip_fore_left on fore_left: static = mu_static, kinetic = mu_kinetic, slip = (
        der(x + a * cos(psi) - b * sin(psi)), der(y + a * sin(psi) + b * cos(psi)))),
    friction(grip_fore_right on fore_right: static = mu_static, kinetic = mu_kinetic, slip = (
        der(x + a * cos(psi) + b * sin(psi)), der(y + a * sin(psi) - b * cos(psi)))),
    friction(grip_rear_left on rear_left: static = mu_static, kinetic = mu_kinetic, slip = (
        der(x - a * cos(psi) - b * sin(psi)), der(y - a * sin(psi) + b * cos(psi)))),
    friction(grip_rear_right on rear_right: static = mu_static, kinetic = mu_kinetic, slip = (
        der(x - a * cos(psi) + b * sin(psi)), der(y - a * sin(psi) - b * cos(psi)))),
    force(push: (rate * t * cos(direction), rate * t * sin(direction)) at (x, y)),
    start(standing: x = 0),
    // Directions of the table, and what is large enough to be seen.
    define(
        forward = [cos(psi) * cos(pitch), sin(psi) * cos(pitch), sin(pitch)],
        left = [-cos(psi) * sin(roll) * sin(pitch) - sin(psi) * cos(roll),
            -sin(psi) * sin(roll) * sin(pitch) + cos(psi) * cos(roll), sin(roll) * cos(pitch)],
        up = cross(forward, left),
        centre = [x, y, z],
        foot = [centre + a * forward + b * left, centre + a * forward - b * left,
            centre - a * forward + b * left, centre - a * forward - b * left],
        high = 3/5 * length,
        thick = length/25,
    ),
    draw(floor: 0),
    draw(path: centre),
    draw(box: centre + (high + thick/2) * up, size = (length + 2*thick, width + 2*thick, thick),
        turn = ((0, 0, psi), (0, -pitch, 0), (roll, 0, 0))),
    draw(box[k in 0..4]: foot[k] + high/2 * up, size = (thick, thick, high),
        turn = ((0, 0, psi), (0, -pitch, 0), (roll, 0, 0))),
    draw(arrow: push * (cos(direction), sin(direction), 0) at centre),
    draw(arrow: fore_left * (0, 0, 1) at foot[0]),
    draw(arrow: (grip_fore_left[0], grip_fore_left[1], 0) at foot[0]),
    draw(arrow: fore_right * (0, 0, 1) at foot[1]),
    draw(arrow: (grip_fore_right[0], grip_fore_right[1], 0) at foot[1]),
    draw(arrow: rear_left * (0, 0, 1) at foot[2]),
    draw(arrow: (grip_rear_left[0], grip_rear_left[1], 0) at foot[2]),
    draw(arrow: rear_right * (0, 0, 1) at foot[3]),
    draw(arrow: (grip_rear_right[0], grip_rear_right[1], 0) at foot[3]),
    emit = data,
)]
pub struct Table<T = f64> {
    /// Mass, kg.
    pub mass: T,
    /// Moment of inertia about each axis, kg m².
    pub inertia: T,
    /// Distance of the legs along, m.
    pub length: T,
    /// Distance of the legs across, m.
    pub width: T,
    /// Gravitational acceleration, m/s².
    pub gravity: T,
    /// Coefficient of static friction.
    pub mu_static: T,
    /// Coefficient of kinetic friction.
    pub mu_kinetic: T,
    /// Growth r of the push, N/s.
    pub rate: T,
    /// Direction β of the push, rad from the x axis.
    pub direction: T,
}

impl Default for Table {
    fn default() -> Self {
        Self {
            mass: 12.0,
            inertia: 2.0,
            length: 1.2,
            width: 0.7,
            gravity: 9.81,
            mu_static: 0.5,
            mu_kinetic: 0.4,
            rate: 20.0,
            direction: 0.6,
        }
    }
}
