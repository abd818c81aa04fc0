// An index made of a field.
#[lagrange(
    coordinates(x[3]),
    kinetic = sum(i in 0..3: mass/2 * der(x[i])^2),
    observe(last = x[mass]),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:22 E306 expected a whole number known at build time; indices and bounds are made of numbers and indices, not of parameters or coordinates
