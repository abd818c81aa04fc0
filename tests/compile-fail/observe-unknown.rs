// An output that is nothing.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(z),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:13 E201 `z` is not known; declare it as a parameter (a field of the struct), a coordinate, or with `define`
