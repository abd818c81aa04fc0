// A quotient by a list.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    define(p = [x, y], q = 1/p),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:30 E316 nothing can be divided by a list; divide by a single value: an element `e[i]`, `norm(e)` or `dot(e, e)`
