//! A table on four legs is pushed until it slides.

use crate::space::{Pose, Solid, Space, Vector};
use lagrange_core::prelude::*;

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

impl Table {
    /// A table top on four legs, with the forces at their feet.
    pub fn drawing(&self, t: f64, q: &[f64]) -> Space {
        let foot = Pose::at(q[0], q[1], q[3])
            .turned(Vector::z(), q[2])
            .turned(Vector::y(), -q[4])
            .turned(Vector::x(), q[5]);
        let (height, thick) = (0.6 * self.length, 0.04 * self.length);
        let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        let corner = corners.map(|[along, across]| {
            foot.moved(along * self.length / 2.0, across * self.width / 2.0, 0.0)
        });
        let leg =
            |pose: Pose| Solid::Box([thick, thick, height], pose.moved(0.0, 0.0, height / 2.0));
        let top = [self.length + 2.0 * thick, self.width + 2.0 * thick, thick];
        let push = self.rate * t * Vector::new(self.direction.cos(), self.direction.sin(), 0.0);
        let legs = corner.map(leg);
        let table = [
            Solid::Ground(Pose::at(0.0, 0.0, 0.0)),
            Solid::Trace(foot.at),
            Solid::Box(top, foot.moved(0.0, 0.0, height + thick / 2.0)),
        ];
        let names = [
            (
                "fore_left",
                "grip_fore_left",
                ["grip_fore_left[0]", "grip_fore_left[1]"],
            ),
            (
                "fore_right",
                "grip_fore_right",
                ["grip_fore_right[0]", "grip_fore_right[1]"],
            ),
            (
                "rear_left",
                "grip_rear_left",
                ["grip_rear_left[0]", "grip_rear_left[1]"],
            ),
            (
                "rear_right",
                "grip_rear_right",
                ["grip_rear_right[0]", "grip_rear_right[1]"],
            ),
        ];
        let drawing = Space::of(table.into_iter().chain(legs)).applied("push", foot.at, push);
        names
            .into_iter()
            .zip(corner)
            .fold(drawing, |drawing, ((foot, grip, [x, y]), pose)| {
                drawing.force(foot, pose.at, [(foot, Vector::z())]).force(
                    grip,
                    pose.at,
                    [(x, Vector::x()), (y, Vector::y())],
                )
            })
    }
}
