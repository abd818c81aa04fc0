// A value given twice.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    start(rest: x = 1, x = 2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:24 E510 `x` is given twice; keep one
