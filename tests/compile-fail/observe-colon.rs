// An output is named by an equals sign.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = mass * gravity * x,
    observe(speed: der(x)),
)]
struct S { mass: f64, gravity: f64 }
//~ 6:18 E001 expected `=`, found `:`
