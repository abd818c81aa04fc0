// A constraint that follows from two others.
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    constraint(first: x == y),
    constraint(second: y == z),
    constraint(third: x == z),
)]
struct S { mass: f64 }
//~ 7:16 E603 `third` says nothing that `first`, `second` does not say already; take one of them away: their forces cannot be told apart
