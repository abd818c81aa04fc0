// Kinetic and static friction exchanged.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x), static = 0.3, kinetic = 0.5),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:68 E513 kinetic friction 0.5 is larger than static friction 0.3; the kinetic coefficient is at most the static one: are they exchanged?
