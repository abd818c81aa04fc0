// Macros are Rust.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * vec![theta],
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:47 E001 expected an operator or a comma, found `!`
