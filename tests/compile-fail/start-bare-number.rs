// A start says of which coordinate the number is.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = mass * gravity * x,
    start(high: 0.3),
)]
struct S { mass: f64, gravity: f64 }
//~ 6:17 E001 expected where the run begins: a position `x = …` or a velocity `der(x) = …`, found `0.3`
