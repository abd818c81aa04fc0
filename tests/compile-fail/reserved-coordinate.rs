// A coordinate called like a function.
#[lagrange(
    coordinates(sin),
    kinetic = mass/2 * der(sin)^2,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:17 E203 `sin` is a word of the language; choose another name
