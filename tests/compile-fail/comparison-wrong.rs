// A constraint is an equation.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(floor: y >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:25 E015 `>=` does not make a constraint; an equation is written `a == b`; one-sided conditions are contacts: `contact(name: a >= b)`
