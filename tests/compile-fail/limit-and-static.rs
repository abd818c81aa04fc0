// Two laws of friction.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    friction(brake: slip = der(x), limit = 5, static = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:5 E023 `limit` and `static` exclude each other; `limit` is the whole friction force; `static`, `kinetic` and `normal`, or `on`, make another
