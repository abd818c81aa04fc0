// A sum that is zero in a form that does not show it.
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = x^2 / ((a + b)^2 - a^2 - 2*a*b - b^2),
)]
struct S { a: f64, b: f64 }
//~ 5:23 E307 division by zero
