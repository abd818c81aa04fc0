// A part given twice.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = 1, restitution = 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:45 E017 `restitution` is given twice; keep one
