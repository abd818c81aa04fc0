// Ranges are half open.
#[lagrange(
    coordinates(x[3]),
    kinetic = sum(i in 0..=2: mass/2 * der(x[i])^2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:25 E020 ranges are half open; write `a..b`, which leaves `b` out
