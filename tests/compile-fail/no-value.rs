// Numbers outside of where a function is defined.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = sqrt(-1), b = ln(0), c = asin(2), d = 0^0, e = (-8)^(1/3)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:17 E314 `sqrt(-1)` has no value; the numbers are outside of where it is defined
//~ 6:31 E314 `ln(0)` has no value; the numbers are outside of where it is defined
//~ 6:42 E314 `asin(2)` has no value; the numbers are outside of where it is defined
//~ 6:55 E314 `0^0` has no value; the numbers are outside of where it is defined
//~ 6:64 E314 `(-8)^(1/3)` has no value; the numbers are outside of where it is defined
