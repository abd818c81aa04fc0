// A stop that compares what does not change.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    stop(end: mass >= 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:10 E506 the stop depends on no coordinate; it never changes: compare something that moves, or `t`
