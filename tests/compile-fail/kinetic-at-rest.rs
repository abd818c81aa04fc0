// A kinetic energy that is not one of motion.
#[lagrange(
    coordinates(x),
    kinetic(whole: mass/2 * der(x)^2),
    kinetic(weight: mass * gravity * x),
    kinetic(term: mass/2 * der(x)^2 - stiffness/2 * x^2),
)]
struct S { mass: f64, gravity: f64, stiffness: f64 }
