//! A beam on three supports: nobody knows what each of them carries, and yet it is certain when it tips.

use lagrange_macros::Lagrangian;

/// A heavy beam lies on three supports; a load rolls along it and beyond the last support.
///
/// Balance gives two equations for three forces: they are not determined. Whether the beam lies still does not depend on
/// how they are shared: it does as long as *some* forces N ≥ 0 hold it, that is as long as weight and load together press
/// between the outer supports. With T = m g + P and the load at distance p from the middle, u p the moment,
///
/// ```text
/// shares of least norm:   N = T/3 + P p x/(2 a²)                  until the left one vanishes, P p = 2 a T/3
///                         0,  T − P p/a,  P p/a                   until it tips
/// tips over the right support:   P p = a T, both others let go at once
/// ```
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, theta),
    define(place = speed * t),
    kinetic   = mass/2 * der(y)^2 + mass * length^2 / 24 * der(theta)^2,
    potential = mass * gravity * y,
    contact(support[k in 0..3]: y * cos(theta) + (k - 1) * span * sin(theta) >= 0),
    force(load: (0, -weight) at (place * cos(theta), y + place * sin(theta))),
    start(resting: y = 0),
    stop(tipped: theta <= -1/10),
    draw(ground[k in 0..3]: ((k - 1) * span, 0)
        to ((k - 1) * span + length/50, -length/20) to ((k - 1) * span - length/50, -length/20)),
    draw(rod: (0, y) - length/2 * (cos(theta), sin(theta)) to (0, y) + length/2 * (cos(theta), sin(theta))),
    draw(mass: (0, y) + place * (cos(theta), sin(theta))),
    draw(arrow[k in 0..3]: support[k] * (-sin(theta), cos(theta)) at ((k - 1) * span, 0)),
    emit = data,
)]
pub struct BeamOnSupports<T = f64> {
    /// Mass, kg.
    pub mass: T,
    /// Length, m.
    pub length: T,
    /// Gravitational acceleration, m/s².
    pub gravity: T,
    /// Distance a of neighbouring supports, m.
    pub span: T,
    /// Weight P of the load, N.
    pub weight: T,
    /// Speed u of the load, m/s.
    pub speed: T,
}

impl Default for BeamOnSupports {
    fn default() -> Self {
        Self {
            mass: 2.0,
            length: 4.0,
            gravity: 9.81,
            span: 0.7,
            weight: 25.0,
            speed: 0.5,
        }
    }
}
