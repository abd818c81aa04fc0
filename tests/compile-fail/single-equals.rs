// An equation needs two.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x^2 + y^2 = length^2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:31 E006 `=` where an equation is expected; an equation is written with two: `a == b`
