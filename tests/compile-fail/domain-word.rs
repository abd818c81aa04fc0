// What a field may be is one of two words.
#[lagrange(coordinates(x), kinetic = mass/2 * der(x)^2)]
struct S { #[lagrange(unit = "kg", domain = "above zero")] mass: f64 }
//~ 3:45 E001 expected `positive` or `nonnegative`, found `above zero`
