// Two items with one name.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x == y),
    contact(rod: y >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:13 E202 `rod` is already the name of a constraint; parameters, coordinates, definitions and items share their names; choose another
