// A conditional constraint is of velocity level.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    constraint(rail while floor: x == 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:21 E505 a constraint that holds while a contact is closed is a velocity constraint; write it with `der(…)`, or leave `while floor` away
