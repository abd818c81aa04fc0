use lagrange_core::prelude::*;

/// A heavy top in Euler angles.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(phi: "rad", theta: "rad", psi: "rad"),
    kinetic = across/2 * (der(theta)^2 + sin(theta)^2 * der(phi)^2) + axle/2 * (der(psi) + cos(theta) * der(phi))^2,
    potential = mass * gravity * arm * cos(theta),
    start(leaning: theta = tilt, der(psi) = spin),
    check(conserved momentum(phi)),
    check(conserved momentum(psi)),
    mark(nods: der(theta)),
    define(centre = arm * [sin(theta) * sin(phi), -sin(theta) * cos(phi), cos(theta)]),
    observe(height = centre[2]),
    draw(floor: 0),
    draw(path: centre),
    draw(rod: (0, 0, 0) to 3/2 * centre),
    draw(disc: centre, radius = 2/3 * arm, height = arm/8, turn = ((0, 0, phi), (theta, 0, 0), (0, 0, psi))),
)]
pub struct HeavyTop<T = f64> {
    #[lagrange(unit = "kg m^2")]
    pub across: T,
    #[lagrange(unit = "kg m^2")]
    pub axle: T,
    #[lagrange(unit = "kg")]
    pub mass: T,
    #[lagrange(unit = "m")]
    pub arm: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "rad/s")]
    pub spin: T,
    #[lagrange(unit = "rad")]
    pub tilt: T,
}

impl Default for HeavyTop {
    fn default() -> Self {
        Self {
            across: 0.02,
            axle: 0.01,
            mass: 1.0,
            arm: 0.1,
            gravity: 9.81,
            spin: 100.0,
            tilt: 0.5,
        }
    }
}
