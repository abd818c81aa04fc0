// A ball that gains energy.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = 1.2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:42 E514 1.2 is no restitution; it lies between 0 (no bounce) and 1 (no loss)
