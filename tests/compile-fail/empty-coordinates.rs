// No coordinate in the list.
#[lagrange(
    coordinates(),
    kinetic = mass/2,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:5 E002 nothing is written here; expected coordinates, as in `coordinates(x, y)`; or take the comma away
