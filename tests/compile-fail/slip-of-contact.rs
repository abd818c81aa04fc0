// slip() belongs to frictions.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    observe(a = slip(floor)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:22 E206 `floor` is a contact, not a friction; declare a friction
