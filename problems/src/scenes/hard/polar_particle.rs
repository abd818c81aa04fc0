//! A free particle in polar coordinates passes close to their origin.

use lagrange_macros::Lagrangian;

/// Nothing acts on a particle; it moves straight past the origin at a tiny distance d.
///
/// In polar coordinates almost half a turn happens while it covers a few d. Both r̈ and φ̈ are then large, and cancel
/// almost everywhere else.
///
/// What to expect: x = v t − 1, y = d.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r: "m", phi: "rad"),
    define(x = r * cos(phi), y = r * sin(phi)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    start(passing:
        r = sqrt(lead^2 + distance^2), phi = pi - atan(distance / lead),
        der(r) = -speed * lead / sqrt(lead^2 + distance^2),
        der(phi) = -speed * distance / (lead^2 + distance^2)),
    start(origin: r = 0, der(r) = speed),
    observe(x, y),
    draw(shell: (0, 0), radius = lead/100),
    draw(path: (x, y)),
    draw(mass: (x, y)),
)]
pub struct PolarParticle<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Speed, m/s.
    #[lagrange(unit = "m/s")]
    pub speed: T,
    /// Distance d at which the particle passes the origin, m.
    #[lagrange(unit = "m")]
    pub distance: T,
    /// Distance along the path from the start to that point, m.
    #[lagrange(unit = "m")]
    pub lead: T,
}

impl Default for PolarParticle {
    fn default() -> Self {
        Self {
            mass: 1.0,
            speed: 1.0,
            distance: 1e-6,
            lead: 1.0,
        }
    }
}
