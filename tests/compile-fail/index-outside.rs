// An index past the end.
#[lagrange(
    coordinates(x[3]),
    kinetic = sum(i in 0..4: mass/2 * der(x[i])^2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:45 E305 the index 3 is outside 0..3; indices start at the lower bound, and the upper bound is left out
