// Rust's suffix of a number.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2.0_f64 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:20 E007 `2.0_f64` is not a number; numbers are exact and have no type: write `2.0`
