// Accelerations are known afterwards.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    force(push: x = der(der(y))),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:21 E402 `der(der(y))` is an acceleration; accelerations are known after the equations are solved: in `observe`, `stop`, `mark` and `check` only
