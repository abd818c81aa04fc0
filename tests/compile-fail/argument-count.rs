// A function with too many arguments.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta, 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:44 E301 `cos` takes 1 argument, not 2
