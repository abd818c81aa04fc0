// Places depend on positions.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(mass: (der(x), y)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:17 E401 a picture depends on positions only, and `der(x)` is a velocity; velocities may stand in `kinetic`, `lagrangian`, `constraint`, slip, `force`, `dissipation` and outputs
