// A list where one value is expected.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = [x, y],
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:17 E302 a list of 2 where a single value is expected; take one element `e[i]`, or `dot`, `norm`, `sum`
