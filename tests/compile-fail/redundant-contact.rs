// The same contact twice.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    contact(ground: y >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:13 E603 `ground` says nothing that `floor` does not say already; take one of them away: their forces cannot be told apart
