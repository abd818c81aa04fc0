// Coordinates are separated by commas.
#[lagrange(
    coordinates(x y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
)]
struct S { mass: f64 }
//~ 3:19 E003 expected a comma before `y`; parts are separated by commas
