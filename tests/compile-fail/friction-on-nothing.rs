// Friction on a name that is no contact.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on flor: slip = der(x), static = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:22 E201 `flor` is not known; did you mean `floor`?
