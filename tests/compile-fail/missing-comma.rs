// Parts without a comma between them.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:5 E003 expected a comma before `potential`; parts are separated by commas
