// An index on a single coordinate.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = x[0]),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:17 E303 a single value where a list is expected; `x` is one number; take the index away, or declare it as a list
