// An operator without an operand.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:35 E001 expected a value, found `*`
