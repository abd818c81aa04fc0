// A misspelt key of a field attribute.
#[lagrange(coordinates(x), kinetic = mass/2 * der(x)^2)]
struct S { #[lagrange(units = "kg")] mass: f64 }
//~ 3:23 E016 `units` is not a part of `#[lagrange(…)]`; did you mean `unit`?
