// The same constraint twice.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(left: x^2 + y^2 == length^2),
    constraint(right: x^2 + y^2 == length^2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:16 E603 `right` says nothing that `left` does not say already; take one of them away: their forces cannot be told apart
