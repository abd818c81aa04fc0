use lagrange_core::prelude::*;

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravty * y,
    constraint(rod: x^2 + y^2 = length^2),
)]
struct Pendulum {
    mass: f64,
    gravity: f64,
    length: f64,
}

fn main() {}
