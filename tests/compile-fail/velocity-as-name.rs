// A velocity has no name of its own.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * v^2,
    potential = mass * gravity * x,
    start(thrown: v = 1, x_dot = 1),
)]
struct S { mass: f64, gravity: f64 }
//~ 4:24 E201 `v` is not known; the velocity of `x` is written `der(x)`
//~ 6:19 E201 `v` is not known; the velocity of `x` is written `der(x)`
//~ 6:26 E201 `x_dot` is not known; the velocity of `x` is written `der(x)`
