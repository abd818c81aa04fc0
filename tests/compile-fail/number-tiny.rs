// A state of a run, whose numbers are doubles, written as a start.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    start(again: der(x) = -1.3120435741600753e-34),
)]
struct S { mass: f64 }
//~ 5:28 E009 `1.3120435741600753e-34` cannot be kept exactly; a number in an expression has at most 38 digits: make it a parameter, which is a double
