// A coordinate with the name of a field.
#[lagrange(
    coordinates(mass),
    kinetic = 2 * length^2 * der(mass)^2,
    potential = -1 * gravity * length * cos(mass),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:17 E202 `mass` is already the name of a parameter; parameters, coordinates, definitions and items share their names; choose another
