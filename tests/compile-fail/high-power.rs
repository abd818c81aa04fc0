// An exponent that nobody means.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = x^1000000),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:19 E315 this exponent is too large; numerators and denominators of exponents go up to 1000
