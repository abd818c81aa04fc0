// A point with fewer directions than coordinates.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    contact(wall: x <= length at (x, 0)),
)]
struct S { mass: f64, length: f64 }
//~ 5:34 E518 this point cannot move in as many directions as it has coordinates; the gap has no slope in the others: name the point by coordinates that move freely, as in `at x`, or leave `at` out where the gap is itself a distance
