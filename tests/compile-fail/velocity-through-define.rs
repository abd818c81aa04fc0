// A velocity that comes in through a definition.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    define(speed = der(x)),
    contact(floor: y + speed >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:24 E401 a gap depends on positions only, and `speed` is a velocity; velocities may stand in `kinetic`, `lagrangian`, `constraint`, slip, `force`, `dissipation` and outputs
