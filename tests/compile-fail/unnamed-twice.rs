// Two unnamed potentials.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
    potential = 1,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:5 E511 a second `potential =` without a name; name the terms: `potential(name: …)`
