// A gap depends on positions.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y + der(x) >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:24 E401 a gap depends on positions only, and `der(x)` is a velocity; velocities may stand in `kinetic`, `lagrangian`, `constraint`, slip, `force`, `dissipation` and outputs
