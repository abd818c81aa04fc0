// Paths are Rust.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * f64::cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:44 E021 `f64::cos` is not written so; write `cos(…)`
