// A kinetic energy that is not one of motion.
#[lagrange(
    coordinates(x),
    kinetic(whole: mass/2 * der(x)^2),
    kinetic(weight: mass * gravity * x),
)]
struct S { mass: f64, gravity: f64, stiffness: f64 }
//~ 5:21 E515 `mass*gravity*x` has no velocity; a kinetic energy is made of `der(…)`; an energy of position belongs in `potential`, with the opposite sign
