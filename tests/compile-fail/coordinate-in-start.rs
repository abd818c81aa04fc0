// Starts are made of parameters.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    start(rest: x = y),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:21 E403 a start depends on parameters and t only, and `y` depends on the motion; use parameters, numbers and `t`
