// Functions cannot be defined.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    define(f(u) = u^2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:12 E028 `f(…)` cannot be defined: there are no functions of one's own; `define` names an expression; indexed it is `f[k in 0..n] = …`
