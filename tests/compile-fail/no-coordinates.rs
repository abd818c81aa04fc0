// Nothing moves.
#[lagrange(
    kinetic = mass/2,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:8 E501 no coordinates are declared; add `coordinates(x, …)`
