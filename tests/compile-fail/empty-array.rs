// An array of no coordinates.
#[lagrange(
    coordinates(x[0]),
    kinetic = mass/2,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:19 E310 the range 0..0 is empty; the upper bound must be larger than the lower one
