use lagrange_core::prelude::*;

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(floor: y >= 0),
    friction(grip on flor: slip = der(x), static = mu),
    constraint(guide: der(x)^2 == 1),
)]
struct Block {
    mass: f64,
    mu: f64,
}

fn main() {}
