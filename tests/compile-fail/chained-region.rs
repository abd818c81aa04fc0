// A region is one comparison.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(table: y >= 0, where 0 <= x <= length),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:41 E014 comparisons do not chain; a region is one comparison: for `a <= x <= b` write `where min(x - a, b - x) >= 0`
