//! A ball rolls down a sphere: where does it leave?

use crate::closed_form::slide;
use lagrange_core::prelude::State;
use lagrange_macros::Lagrangian;
use lagrange_program::closed_form::ClosedForm;

/// A solid sphere rolls without slipping down a fixed spherical shell, leaves it and falls, still spinning.
///
/// r and θ place its centre, φ is how far it has turned. Rolling is a condition on velocities, and it holds only
/// while the sphere touches: `constraint(rolling while shell: …)`. Its multiplier is the friction force that
/// rolling needs, however large that is; see [`RollingSlippingSphere`](super::RollingSlippingSphere) for a ball
/// that cannot have as much as it needs.
///
/// What to expect, with the moment of inertia I = ⅖ m a²:
///
/// ```text
/// θ̈ = (5/7) g sin θ / (R + a)
/// N = (m g / 7) (17 cos θ − 10 cos θ₀)        leaves at cos θ = (10/17) cos θ₀ (53.97° from the top)
/// F = −(2/7) m g sin θ                        uphill, against the slip it prevents
/// ```
///
/// Later than a sliding mass, since part of the energy has gone into the spin.
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
    constraint(rolling while shell: radius * der(theta) == sphere_radius * (der(phi) - der(theta))),
    start(rest: r = radius + sphere_radius, theta = start_angle),
    observe(x, y),
    stop(floor: y <= -radius),
    check(rolls: der(der(theta)) == 5/7 * gravity * sin(theta) / (radius + sphere_radius) when closed(shell)),
    check(normal: shell == mass * gravity / 7 * (17*cos(theta) - 10*cos(start_angle))
        when closed(shell) and energy == mass * gravity * (radius + sphere_radius) * cos(start_angle)),
    check(uphill: rolling == -2/7 * mass * gravity * sin(theta) when closed(shell)),
    check(conserved energy),
    draw(floor: -radius - sphere_radius),
    draw(shell: (0, 0), radius = radius),
    draw(path: (x, y)),
    draw(disc: (x, y), radius = sphere_radius, angle = -phi),
    draw(arrow: shell * (sin(theta), cos(theta)) at (r - sphere_radius) * (sin(theta), cos(theta))),
    draw(arrow: rolling * (cos(theta), -sin(theta)) at (r - sphere_radius) * (sin(theta), cos(theta))),
)]
pub struct RollingSphere<T = f64> {
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
    /// θ at the start, rad from the upward vertical.
    #[lagrange(unit = "rad", symbol = "theta_0")]
    pub start_angle: T,
}

impl Default for RollingSphere {
    fn default() -> Self {
        Self {
            mass: 1.0,
            radius: 1.0,
            sphere_radius: 0.2,
            gravity: 9.81,
            start_angle: 0.01,
        }
    }
}

impl RollingSphere {
    /// The run from rest on the shell to the floor; none for other starts and for runs that end before.
    pub fn closed_form(&self, start: &State<f64>, until: f64) -> Option<ClosedForm> {
        let hill = slide::Hill {
            radius: self.radius + self.sphere_radius,
            gravity: self.gravity,
            share: 5.0 / 7.0,
            leaving: 10.0 / 17.0,
            ground: -self.radius,
        };
        let [r, theta, phi] = start.q[..].try_into().ok()?;
        if r != hill.radius || start.v != [0.0; 3] {
            return None;
        }
        let moments = hill.descent(theta)?;
        let [leave, land] = &moments;
        // While it rolls a φ = (R + a) θ, but for a constant; in flight it spins on.
        let gear = hill.radius / self.sphere_radius;
        let spin = gear * leave.turning;
        let turned = phi + gear * (leave.theta - theta) + spin * (land.time - leave.time);
        let state = State::new(
            vec![land.r, land.theta, turned],
            vec![land.rising, land.turning, spin],
        );
        slide::landing(&moments, until, "shell lost", state)
    }
}
