use lagrange_core::prelude::*;

/// A robot arm with two links whose joints rub.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(q[2]: "rad"),
    define(
        elbow = [length[0] * cos(q[0]), length[0] * sin(q[0])],
        hand = elbow + [length[1] * cos(q[0] + q[1]), length[1] * sin(q[0] + q[1])],
        centre = (elbow + hand)/2,
    ),
    kinetic = mass[0] * length[0]^2/6 * der(q[0])^2 + mass[1]/2 * dot(der(centre), der(centre)) + mass[1] * length[1]^2/24 * (der(q[0]) + der(q[1]))^2 + load/2 * dot(der(hand), der(hand)),
    potential = gravity * (mass[0] * elbow[1]/2 + mass[1] * centre[1] + load * hand[1]),
    friction(rub[k in 0..2]: slip = der(q[k]), limit = dry[k]),
    start(stretched: q = [0.5, 0.3]),
    observe(hand),
    draw(path: hand), draw(rod: (0, 0) to elbow to hand), draw(pivot: (0, 0)), draw(mass: hand),
)]
pub struct RobotArm<T = f64> {
    #[lagrange(unit = "m")]
    pub length: [T; 2],
    #[lagrange(unit = "kg")]
    pub mass: [T; 2],
    #[lagrange(unit = "m/s^2")]
    pub gravity: T,
    #[lagrange(unit = "N m")]
    pub dry: [T; 2],
    #[lagrange(unit = "kg")]
    pub load: T,
}

impl Default for RobotArm {
    fn default() -> Self {
        Self {
            length: [0.5, 0.4],
            mass: [3.0, 2.0],
            gravity: 9.81,
            dry: [1.5, 0.8],
            load: 0.5,
        }
    }
}
