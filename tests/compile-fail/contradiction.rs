// Two constraints that cannot both hold.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(left: x == 0),
    constraint(right: x == 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:16 E604 `right` cannot hold together with `left`; they restrict the same motion in two ways: take one away
