// Energy is taken by a dissipation.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = mass * gravity * x,
    dissipation(air: drag/2 * der(x)^2),
    check(conserved energy),
)]
struct S { mass: f64, gravity: f64, drag: f64 }
//~ 7:11 E801 `conserved energy` does not hold; at mass = 1.75, gravity = 1.48, drag = 0.83, der(x) = 1.12: its rate is -1.04115; `air` gives energy or takes it
