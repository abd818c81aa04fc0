// gap() belongs to outputs.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * gap(floor),
    contact(floor: y >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:34 E405 `gap` has a value after the equations are solved; use it in `observe`, `stop`, `mark` or `check`
