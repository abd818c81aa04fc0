// Friction on something that cannot press.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    friction(grip on mass: slip = der(x), static = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:22 E206 `mass` is a parameter, not a contact or constraint; declare a contact
