// Either or.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
    lagrangian = mass * der(theta)^2,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:5 E503 `lagrangian` stands for the kinetic and potential energies, and `kinetic` is given too; keep one of them
//~ 5:5 E503 `lagrangian` stands for the kinetic and potential energies, and `potential` is given too; keep one of them
