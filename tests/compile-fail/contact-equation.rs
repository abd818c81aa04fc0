// A contact is one-sided.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y == 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:22 E015 `==` does not make a comparison; write `gap >= 0`; equations stand in `constraint`
