// Nothing after the equals sign.
#[lagrange(
    coordinates(theta),
    kinetic = ,
    potential = -mass * gravity * length * cos(theta),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:15 E001 expected a value, found `,`
