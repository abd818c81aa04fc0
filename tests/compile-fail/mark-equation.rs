// The zeros of an expression are marked by the expression alone.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = mass * gravity * x,
    mark(top: der(x) == 0),
)]
struct S { mass: f64, gravity: f64 }
//~ 6:22 E015 `==` does not make a comparison; write `a >= b`, or an expression alone, whose zeros are marked; equations stand in `constraint`
