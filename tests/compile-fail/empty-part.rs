// Two commas.
#[lagrange(
    coordinates(theta),,
    kinetic = mass/2 * der(theta)^2,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:24 E002 nothing is written here; expected an item; or take the comma away
