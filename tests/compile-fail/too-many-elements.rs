// An array that would unroll without end.
#[lagrange(
    coordinates(x[100000]),
    kinetic = der(x[0])^2,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:19 E311 100000 elements are too many; a declaration may unroll to 10000
