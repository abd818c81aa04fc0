// A spring that was written into the kinetic energy.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2 - stiffness/2 * x^2,
)]
struct S { mass: f64, stiffness: f64 }
//~ 4:15 E515 this kinetic energy is negative in some states of rest; a kinetic energy is made of `der(…)`; an energy of position belongs in `potential`, with the opposite sign
