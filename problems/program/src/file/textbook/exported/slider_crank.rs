use lagrange_core::prelude::*;

/// A slider-crank mechanism whose slider rubs on its guide, from its dead centre.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta: "rad", phi: "rad", x: "m", y: "m"),
    define(
        pin = [crank * cos(theta), crank * sin(theta)],
        centre = pin + [rod/2 * cos(phi), -rod/2 * sin(phi)],
        end = pin + [rod * cos(phi), -rod * sin(phi)],
    ),
    kinetic = wheel/2 * der(theta)^2 + rod_mass/2 * dot(der(centre), der(centre)) + rod_mass * rod^2/24 * der(phi)^2 + piston/2 * (der(x)^2 + der(y)^2),
    potential = gravity * (rod_mass * centre[1] + piston * y),
    constraint(joint_x: x == end[0]),
    constraint(joint_y: y == end[1]),
    constraint(guide: y == 0),
    friction(rub on guide: slip = der(x), static = mu, kinetic = mu),
    start(turning: x = crank + rod, der(theta) = rate, der(phi) = rate * crank/rod),
    draw(ground: (2/3 * rod, -rod/12) to (3/2 * rod, -rod/12) to (3/2 * rod, -rod/6) to (2/3 * rod, -rod/6)),
    draw(disc: (0, 0), radius = crank, angle = theta - pi/2),
    draw(box: (x, 0), size = (rod/4, rod/6)),
    draw(rod: pin to end),
)]
pub struct SliderCrank<T = f64> {
    #[lagrange(unit = "m")]
    pub crank: T,
    #[lagrange(unit = "m")]
    pub rod: T,
    #[lagrange(unit = "kg m^2")]
    pub wheel: T,
    #[lagrange(unit = "kg")]
    pub rod_mass: T,
    #[lagrange(unit = "kg")]
    pub piston: T,
    pub mu: T,
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "rad/s")]
    pub rate: T,
}

impl Default for SliderCrank {
    fn default() -> Self {
        Self {
            crank: 0.1,
            rod: 0.3,
            wheel: 0.05,
            rod_mass: 0.5,
            piston: 1.0,
            mu: 0.1,
            gravity: 9.81,
            rate: 30.0,
        }
    }
}
