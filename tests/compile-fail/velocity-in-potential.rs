// A potential depends on positions.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * der(y),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:34 E401 a potential energy depends on positions only, and `der(y)` is a velocity; velocities may stand in `kinetic`, `lagrangian`, `constraint`, slip, `force`, `dissipation` and outputs
