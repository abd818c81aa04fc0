// A region in two conditions.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, where x >= 0, where x <= 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:42 E017 `where` is given twice; a region is one comparison; for two write `where min(a, b) >= 0`
