// A misspelt keyword.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potental = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:5 E010 `potental` is not an item; did you mean `potential`?
