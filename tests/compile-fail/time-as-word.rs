// Time by its English name.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    force(push: x = mass * time),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:28 E201 `time` is not known; time is written `t`
