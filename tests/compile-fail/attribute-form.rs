// The attribute without parentheses.
#[lagrange = "coordinates(x)"]
struct S { mass: f64 }
//~ 2:3 E104 `lagrange` takes parentheses; write `#[lagrange(coordinates(x), kinetic = …)]`
