// Accelerations cannot be set.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    start(pushed: der(der(x)) = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:23 E001 expected a coordinate: a start gives positions `x = …` and velocities `der(x) = …`, found `der`
