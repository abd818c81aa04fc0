// Two names that become one constant.
#[lagrange(
    coordinates(x, X),
    kinetic = mass/2 * (der(x)^2 + der(X)^2),
)]
struct S { mass: f64 }
//~ 3:20 E208 `X` and `x` become one constant, `X`; names of coordinates and items become constants in capitals: choose another
