// The product of two lists has no single meaning.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    define(p = [x, y], q = p * p),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:32 E313 the product of two lists has no single meaning; write `dot(a, b)`, `cross(a, b)`, or single elements
