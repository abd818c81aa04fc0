// A unit that does not exist.
#[lagrange(
    coordinates(x: "metre", y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:20 E701 `metre` is not a unit; write `m`
