// Expressions stand without quotation marks.
#[lagrange(
    coordinates(x),
    kinetic = "mass/2 * der(x)^2",
)]
struct S { mass: f64 }
//~ 4:15 E021 `"mass/2 * der(x)^2"` is not written so; write the expression without quotation marks; only units have them
