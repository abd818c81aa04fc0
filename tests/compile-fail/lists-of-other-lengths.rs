// Lists that do not fit.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    define(p = [x, y], q = p + [1, 2, 3]),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:32 E304 lists of 2 and 3 elements do not fit; both sides need as many elements
