// An index with the name of a field.
#[lagrange(
    coordinates(x[3]),
    kinetic = sum(mass in 0..3: der(x[mass])^2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 4:19 E204 the index `mass` hides the parameter of that name; choose another letter
