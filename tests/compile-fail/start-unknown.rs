// A start of something that is no coordinate.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    start(rest: z = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:17 E201 `z` is not known; known are `x`, `y`
