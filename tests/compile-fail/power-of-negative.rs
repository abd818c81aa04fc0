// A power of a negative number whose exponent is not a number.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    observe(a = (-1)^y, b = sum(k in 0..3: (-1)^k * x)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:17 E314 `(-1)^y` has no value; the numbers are outside of where it is defined
