// Friction needs a slip.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on floor: static = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:14 E018 `grip` has no slip velocity; add `slip = …`
