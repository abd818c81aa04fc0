// An operator that does not exist.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity % length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:33 E024 `%` is not an operator here; there is no remainder in the language
