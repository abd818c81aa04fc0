// A velocity is no member of its coordinate.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = mass * gravity * x,
    observe(rate = x.dot),
)]
struct S { mass: f64, gravity: f64 }
//~ 6:22 E309 `x` has no member `dot`; its velocity is written `der(x)`
