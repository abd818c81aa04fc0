//! Where does a mass that slides down a smooth sphere leave it?

use crate::closed_form::slide;
use lagrange_core::prelude::State;
use lagrange_macros::Lagrangian;
use lagrange_program::closed_form::ClosedForm;

/// A point mass slides without friction down a fixed spherical shell, leaves it and falls.
///
/// The coordinates are those of the *flying* mass: r and θ, both free. The shell is the inequality `r >= radius`.
/// While it is closed its multiplier is the normal force; where that falls to zero the mass leaves, and no other
/// equation has to be written for the flight.
///
/// What to expect: energy gives R θ̇² = 2 g (cos θ₀ − cos θ), the radial equation N = m g cos θ − m R θ̇², so
///
/// ```text
/// N = m g (3 cos θ − 2 cos θ₀)        leaves at cos θ = ⅔ cos θ₀ (48.19° from the top)
/// ```
///
/// neither of which depends on the mass, the radius or gravity. Then a parabola.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r: "m", theta: "rad"),
    define(
        x = r * sin(theta),
        y = r * cos(theta),
    ),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(shell: r >= radius),
    start(rest: r = radius, theta = start_angle),
    observe(x, y),
    stop(floor: y <= -radius),
    check(normal: shell == mass * gravity * cos(theta) - mass * radius * der(theta)^2 when closed(shell)),
    check(from_rest: shell == mass * gravity * (3*cos(theta) - 2*cos(start_angle))
        when closed(shell) and energy == mass * gravity * radius * cos(start_angle)),
    check(falling: der(der(y)) == -gravity when open(shell)),
    check(conserved energy),
    draw(floor: -radius),
    draw(shell: (0, 0), radius = radius),
    draw(path: (x, y)),
    draw(mass: (x, y)),
    draw(arrow: shell * (sin(theta), cos(theta)) at (x, y)),
)]
pub struct MassOnShell<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius of the shell, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// θ at the start, rad from the upward vertical.
    #[lagrange(unit = "rad", symbol = "theta_0")]
    pub start_angle: T,
}

impl Default for MassOnShell {
    fn default() -> Self {
        Self {
            mass: 1.0,
            radius: 1.0,
            gravity: 9.81,
            start_angle: 0.01,
        }
    }
}

impl MassOnShell {
    /// The run from rest on the shell to the floor; none for other starts and for runs that end before.
    pub fn closed_form(&self, start: &State<f64>, until: f64) -> Option<ClosedForm> {
        let hill = slide::Hill {
            radius: self.radius,
            gravity: self.gravity,
            share: 1.0,
            leaving: 2.0 / 3.0,
            ground: -self.radius,
        };
        let [r, theta] = start.q[..].try_into().ok()?;
        if r != self.radius || start.v != [0.0; 2] {
            return None;
        }
        let moments = hill.descent(theta)?;
        let land = &moments[1];
        let state = State::new(vec![land.r, land.theta], vec![land.rising, land.turning]);
        slide::landing(&moments, until, "shell lost", state)
    }
}
