// A string is not a value.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * "theta",
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:44 E021 `"theta"` is not written so; write the expression without quotation marks; only units have them
