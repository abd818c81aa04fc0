// A comparison has no value.
#[lagrange(
    coordinates(theta),
    kinetic = (mass >= 2) * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:21 E012 a comparison is not a value; `if(a >= b, x, y)` chooses between values; `stop`, `mark`, `contact` and `constraint` take comparisons
