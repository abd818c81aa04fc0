// An arrow shows forces.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    draw(arrow: (mass * der(der(x)), 0) at (x, y), name = inertia),
    draw(arrow: (momentum(x), 0) at (x, y), name = momentum_of_x),
)]
struct S { mass: f64 }
//~ 5:25 E402 `der(der(x))` is an acceleration; accelerations are known after the equations are solved: in `observe`, `stop`, `mark` and `check` only
//~ 6:18 E405 `momentum` has a value after the equations are solved; use it in `observe`, `stop`, `mark` or `check`
