// An output and a coordinate that become one constant.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    observe(X = x^2),
)]
struct S { mass: f64 }
//~ 5:13 E208 `X` and `x` become one constant, `X`; names of coordinates and items become constants in capitals: choose another
