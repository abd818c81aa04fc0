// A coordinate without kinetic energy.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2),
    potential = mass * gravity * y,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:20 E601 the coordinate `y` has no inertia; no kinetic energy is quadratic in `der(y)`, and no constraint ties it: add its kinetic energy, tie it with `constraint(name: der(y) == …)`, or remove it
