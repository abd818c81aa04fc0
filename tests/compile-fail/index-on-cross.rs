// An element of a vector product in the plane, which is a number.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    observe(swept = cross([x, y], [der(x), der(y)])[2]),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:21 E303 a single value where a list is expected; `cross` of two lists of two is one number, a₀b₁ − a₁b₀; take the index away
