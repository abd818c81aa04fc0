// A list is taken from a number.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    define(p = [x, y], q = 1 - p),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:32 E302 a list of 2 where a single value is expected; a single value and a list do not add; write the single value as a list, `[a, a]`
