// Two coordinates with one inertia.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x) + der(y))^2,
    potential = mass * gravity * y,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:17 E606 `x`, `y` can move together without kinetic energy; add the kinetic energy of that motion, or a constraint that forbids it
