// The force of a contact is not known in an energy.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * floor,
    contact(floor: y >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:34 E406 `floor` is a contact, whose force is not known here; `force`, `dissipation` and a `define` for them may contain contacts and constraints; every output may contain all
