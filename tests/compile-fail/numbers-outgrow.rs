// Exact numbers that overflow.
#[lagrange(
    coordinates(theta),
    kinetic = mass * (1234567890123456789/1234567890123456791)^9 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:22 E312 the exact numbers of `(1234567890123456789/1234567890123456791)^9` outgrow 38 digits; make such numbers parameters
