// An item for no index.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(wall[k in 2..2]: x >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:23 E310 the range 2..2 is empty; the upper bound must be larger than the lower one
