// Two equations in one constraint.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(hook: x == 0 and y == 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:29 E024 `and` is not an operator here; a constraint is one equation: write a constraint for each
