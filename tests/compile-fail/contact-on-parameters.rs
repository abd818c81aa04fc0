// A gap that nothing moves.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(rod: length >= 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:18 E506 the gap depends on no coordinate; write a distance between coordinates: `contact(floor: y >= 0)`
