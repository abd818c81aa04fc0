// der() of nothing.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = der()),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:17 E002 nothing is written here; expected an argument; or take the comma away
