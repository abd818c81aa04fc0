// A number that cannot be exact.
#[lagrange(
    coordinates(theta),
    kinetic = mass/1e99 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:20 E009 `1e99` cannot be kept exactly; a number in an expression has at most 38 digits: make it a parameter, which is a double
