// A field called like a word of the language.
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
)]
struct S { mass: f64, der: f64 }
//~ 6:23 E203 `der` is a word of the language; choose another name
