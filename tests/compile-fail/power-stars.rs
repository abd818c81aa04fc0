// Python's power.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length**2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:30 E004 `**` is not an operator here; a power is written with `^`: `x^2`
