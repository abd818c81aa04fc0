// Two slip components that are one.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on floor: slip = (der(x), 2*der(x)), static = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:14 E605 the two components of the slip of `grip` are one; write velocities in two directions, or a slip of one component
