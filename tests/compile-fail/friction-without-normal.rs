// No normal force.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    friction(grip: slip = der(x), static = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:14 E018 `grip` has no normal force; add `on contact` or `normal = N`
