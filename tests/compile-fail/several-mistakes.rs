// All mistakes of a stage are reported at once.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravty * y,
    observe(a = lenght, b = x + z),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:24 E201 `gravty` is not known; did you mean `gravity`?
//~ 6:17 E201 `lenght` is not known; did you mean `length`?
//~ 6:33 E201 `z` is not known; declare it as a parameter (a field of the struct), a coordinate, or with `define`
