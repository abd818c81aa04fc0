// No attribute.
struct S { mass: f64 }
//~ 2:8 E105 nothing is declared; add `#[lagrange(coordinates(…), kinetic = …, potential = …)]` to the struct
