// Friction needs a coefficient.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:14 E018 `grip` has no coefficient; add `static = mu`
