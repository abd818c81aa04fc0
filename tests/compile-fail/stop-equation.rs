// A stop is one-sided.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    stop(edge: x == 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:18 E015 `==` does not make a comparison; write `a >= b`; equations stand in `constraint`
