// A string is not a value.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * "theta",
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:44 E008 `"theta"` is not a number of the language; write decimal digits: `12`, `0.5`, `1e-3`
