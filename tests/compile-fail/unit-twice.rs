// Two units.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
)]
struct S { #[lagrange(unit = "kg", unit = "g")] mass: f64, gravity: f64, length: f64 }
//~ 7:36 E017 `unit` is given twice; keep one
