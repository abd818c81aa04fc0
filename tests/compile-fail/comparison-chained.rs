// Comparisons do not chain.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    stop(edge: 0 <= x <= 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:23 E014 comparisons do not chain; write two conditions: `a <= x and x <= b`
