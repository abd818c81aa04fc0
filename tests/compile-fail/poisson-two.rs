// Poisson's hypothesis with two coefficients.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = poisson(0.5, 0.2)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:42 E301 `poisson` takes 1 argument, not 2
