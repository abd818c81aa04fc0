use lagrange_core::prelude::*;

#[derive(Lagrangian, Clone)]
#[lagrange(
    coordinates(r, theta),
    define(x = r * sin(theta), y = r * cos(theta)),
    kinetic = m/2 * (der(x)^2 + der(y)^2),
    potential = m * g * y,
    contact(shell: r >= radius),
    check(shell == m*g*cos(theta) + m*radius*der(theta)^2 when closed(shell)),
)]
struct Shell {
    m: f64,
    g: f64,
    radius: f64,
}

fn main() {}
