// The letters of a textbook are not the names of the parts.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, e = 0.5),
    friction(grip on floor: slip = der(x), mu = 0.3),
)]
struct S { mass: f64, gravity: f64 }
//~ 6:28 E016 `e` is not a part of `contact`; did you mean `restitution`?
//~ 7:44 E016 `mu` is not a part of `friction`; did you mean `static`?
