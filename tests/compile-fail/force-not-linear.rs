// Forces of contacts enter linearly.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    force(push: x = floor^2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:21 E509 the force is not linear in `floor`; the forces of contacts and constraints enter the equations linearly
