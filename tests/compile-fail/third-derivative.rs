// Jerk is not available.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(jerk = der(der(der(x)))),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:20 E404 the derivative of an acceleration or force is not available
