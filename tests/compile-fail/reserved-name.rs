// A word of the language as a name: said once, where it is declared
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * (y - along) + along * x^2,
)]
struct S { mass: f64, gravity: f64, along: f64 }
//~ 7:37 E203 `along` is a word of the language; choose another name
