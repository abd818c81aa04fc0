// A misspelt field: the nearest name is offered.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravty * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:25 E201 `gravty` is not known; did you mean `gravity`?
