// open() of something that is no contact.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    stop(edge: open(x)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:21 E206 `x` is a coordinate, not a contact; declare a contact
