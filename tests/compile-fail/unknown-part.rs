// A misspelt part.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitutoin = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:28 E016 `restitutoin` is not a part of `contact`; did you mean `restitution`?
