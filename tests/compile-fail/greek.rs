// Greek letters are written out.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = x * cos(π)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:25 E201 `π` is not known; write `pi`
