// A slip without its sign.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on floor: slip = abs(der(x)), static = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:36 E504 the slip is not linear in `der(x)`; a slip is a component of a velocity; of two components write `(s1, s2)`, not their norm
