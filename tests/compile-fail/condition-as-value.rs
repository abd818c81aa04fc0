// closed() is a condition.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    observe(a = closed(floor)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:17 E407 `closed(…)` is a condition, not a value; use it in `stop` or `mark`, or behind `when` in a `check`, joined by `and`
