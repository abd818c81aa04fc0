// A gap that does not follow from its point.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: x >= 0 at (0, y)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:30 E508 the gap does not follow from the position of this point; `at` takes the point relative to the body that it touches; leave it out where the gap is itself a distance
