// No kinetic energy.
#[lagrange(
    coordinates(x),
    potential = mass * gravity * x,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:8 E502 no kinetic energy is declared; add `kinetic = mass/2 * der(x)^2`, or a whole `lagrangian = …`
