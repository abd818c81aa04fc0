// A slip is a velocity.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on floor: slip = x, static = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:36 E506 the slip depends on no velocity; a slip is the velocity of the contact point: write it with `der(…)`
