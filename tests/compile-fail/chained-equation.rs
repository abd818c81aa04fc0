// Two equations in one.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x == y == 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:28 E014 comparisons do not chain; write an equation for each
