// A generalized force acts on a coordinate.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    force(push: mass = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:17 E206 `mass` is a parameter, not a coordinate; coordinates are `x`, `y`
