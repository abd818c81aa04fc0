// A law of impact without its key.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, poisson(1/2)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:28 E016 `poisson` is not a part of `contact`; write `restitution = poisson(e)`
