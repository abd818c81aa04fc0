// Found at build time.
#[lagrange(
    coordinates(theta),
    kinetic = mass/0 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:20 E307 division by zero
