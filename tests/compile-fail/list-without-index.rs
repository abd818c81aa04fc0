// A whole array where one value is expected.
#[lagrange(
    coordinates(x[3]),
    kinetic = sum(i in 0..3: mass/2 * der(x[i])^2),
    observe(a = x + 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:21 E303 a single value where a list is expected; a list and a single value do not add; write the list out, `[a, a]`
