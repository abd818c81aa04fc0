use lagrange_core::prelude::*;

/// An Atwood machine whose one mass slides on a table.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", h: "m", phi: "rad"),
    kinetic = slider/2 * der(x)^2 + hanging/2 * der(h)^2 + inertia/2 * der(phi)^2,
    potential = hanging * gravity * h,
    constraint(rope_left: x == radius * phi),
    constraint(rope_right: h == -radius * phi),
    friction(rub: slip = der(x), normal = slider * gravity, static = mu),
    start(rest),
    stop(edge: x >= 1),
    draw(ground: (-0.3, 0) to (1.15, 0) to (1.15, -0.05) to (-0.3, -0.05)),
    draw(rope: (x, radius) to (13 * radius, radius)),
    draw(rope: (14 * radius, 0) to (14 * radius, h - 2 * radius)),
    draw(disc: (13 * radius, 0), radius = radius, angle = -phi),
    draw(box: (x, radius), size = (0.3, 2 * radius)),
    draw(box: (14 * radius, h - 3 * radius), size = (0.15, 0.2)),
)]
pub struct Atwood<T = f64> {
    #[lagrange(unit = "kg")]
    pub slider: T,
    #[lagrange(unit = "kg")]
    pub hanging: T,
    #[lagrange(unit = "kg m^2")]
    pub inertia: T,
    #[lagrange(unit = "m")]
    pub radius: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    pub mu: T,
}

impl Default for Atwood {
    fn default() -> Self {
        Self {
            slider: 2.0,
            hanging: 1.0,
            inertia: 0.01,
            radius: 0.1,
            gravity: 9.81,
            mu: 0.2,
        }
    }
}
