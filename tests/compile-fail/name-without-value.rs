// A start has no value.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    start(rest: x = 1),
    observe(a = rest),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:17 E207 `rest` is a start and has no value; its name is for the run and its report; write the expression itself, or a `define`
