// Impacts need a mass matrix.
#[lagrange(
    coordinates(x),
    lagrangian = -mass * sqrt(1 - der(x)^2),
    contact(floor: x >= 0),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:5 E507 with contacts the Lagrangian must be quadratic in the velocities; impacts need a mass matrix that does not depend on them: `der(x)` occurs otherwise
