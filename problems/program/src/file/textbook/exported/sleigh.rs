use lagrange_core::prelude::*;

/// Chaplygin's sleigh: a body on smooth ice that rests on a skate behind its centre of mass.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    // Where the skate stands, and whither it points.
    coordinates(x: "m", y: "m", psi: "rad"),
    define(heading = [cos(psi), sin(psi)], side = [-sin(psi), cos(psi)], centre = [x, y] + arm * heading),
    kinetic = mass/2 * dot(der(centre), der(centre)) + inertia/2 * der(psi)^2,
    constraint(skate: dot(side, [der(x), der(y)]) == 0),
    start(spun: der(psi) = turn),
    observe(speed = dot(heading, [der(x), der(y)])),
    check(conserved energy),
    check(skate == mass * inertia/(inertia + mass * arm^2) * speed * der(psi)),
    draw(path: (x, y)), draw(path: centre),
    draw(polygon: [x, y] + arm/4 * side to [x, y] - arm/4 * side to [x, y] + 3/2 * arm * heading - arm/2 * side to [x, y] + 3/2 * arm * heading + arm/2 * side),
    draw(rod: [x, y] - arm/4 * heading to [x, y] + arm/4 * heading), draw(mass: centre),
    draw(arrow: skate * side at (x, y)),
)]
pub struct Sleigh<T = f64> {
    #[lagrange(unit = "kg")]
    pub mass: T,
    #[lagrange(unit = "kg m^2")]
    pub inertia: T,
    #[lagrange(unit = "m")]
    pub arm: T,
    #[lagrange(unit = "rad/s")]
    pub turn: T,
}

impl Default for Sleigh {
    fn default() -> Self {
        Self {
            mass: 1.0,
            inertia: 0.02,
            arm: 0.2,
            turn: 6.0,
        }
    }
}
