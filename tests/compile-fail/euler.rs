// Euler's number.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = e^x),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:17 E201 `e` is not known; powers of Euler's number are written `exp(…)`
