// Parts are separated by commas.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0; restitution = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:26 E024 `;` is not an operator here; parts are separated by commas
