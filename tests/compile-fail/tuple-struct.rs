// Parameters have names.
#[lagrange(coordinates(x), kinetic = der(x)^2)]
struct S(f64);
//~ 3:8 E101 Lagrangian is derived for a struct with named fields; write `struct S { mass: f64, … }`: every field is a parameter
