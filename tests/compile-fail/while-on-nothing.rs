// A conditional constraint on a name that is no contact.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rail while floor: der(x) == 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:27 E201 `floor` is not known; declare a contact
