// A velocity constraint must be linear in the velocities.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(speed: der(x)^2 + der(y)^2 == 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:23 E504 the constraint is not linear in `der(x)`; velocity constraints are a·v + b = 0; an energy or speed cannot be constrained
