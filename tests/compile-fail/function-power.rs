// The square of a sine.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = sin^2(x)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:17 E027 `sin^…` is not a power of a value; write `sin(…)^2`
