// Rust's notation for functions.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * theta.cos(),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:50 E005 `.cos()` is the notation of programs; functions are written as in mathematics: `cos(theta)`
