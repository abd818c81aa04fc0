// What this version does not have yet.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    check(energy),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:5 E019 `check` comes with a later version; leave it out, or use `observe`
