// A field without a unit that is used in two ways.
#[lagrange(
    coordinates(x: "m"),
    kinetic = mass/2 * der(x)^2,
    potential(spring: k/2 * x^2),
    force(drag: x = -k * der(x)),
)]
struct S { mass: f64, k: f64 }
//~ 6:21 E704 a force along `x` is in N, and this is in kg m/s³; `k` must be in kg/s² elsewhere: give it a unit, or another name here
