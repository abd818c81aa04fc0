// Forces of constraints press together; contacts do so one by one.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(floor: y >= 0),
    constraint(wall: x == 0),
    friction(rub on (wall, floor): slip = der(x), static = 0.3),
)]
struct S { mass: f64 }
//~ 7:28 E206 `floor` is a contact, not a constraint; known are `wall`
