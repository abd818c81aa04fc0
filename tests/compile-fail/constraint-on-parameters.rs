// A constraint that constrains nothing.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: length == 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:21 E506 the constraint depends on no coordinate; write an equation between coordinates or velocities
