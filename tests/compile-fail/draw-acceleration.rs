// An arrow shows forces.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    draw(arrow: (mass * der(der(x)), 0) at (x, y), name = inertia),
    draw(arrow: (momentum(x), 0) at (x, y), name = momentum_of_x),
)]
struct S { mass: f64 }
