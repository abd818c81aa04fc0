// A misspelt function.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * coss(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:44 E308 `coss` is not a function; did you mean `cos`?
