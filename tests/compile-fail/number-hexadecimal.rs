// A number in another base.
#[lagrange(
    coordinates(theta),
    kinetic = mass/0x10 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:20 E008 `0x10` is not a number of the language; write decimal digits: `12`, `0.5`, `1e-3`
