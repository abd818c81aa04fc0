// Expressions stand without quotation marks.
#[lagrange(
    coordinates(x),
    kinetic = "mass/2 * der(x)^2",
)]
struct S { mass: f64 }
