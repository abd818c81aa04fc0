// A contact is a comparison.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:20 E011 expected a comparison; write `gap >= 0`
