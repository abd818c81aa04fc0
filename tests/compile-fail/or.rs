// Alternatives are items of their own.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    stop(left: x <= 0 or y <= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:23 E024 `or` is not an operator here; conditions are joined by `and`; alternatives are several `stop` or `mark` items
