// Only structs have parameters.
#[lagrange(coordinates(x))]
enum S { A, B }
//~ 3:6 E101 Lagrangian is derived for a struct with named fields; write `struct S { mass: f64, … }`: every field is a parameter
