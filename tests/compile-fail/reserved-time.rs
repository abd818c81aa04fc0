// t is time.
#[lagrange(
    coordinates(t),
    kinetic = mass/2 * der(t)^2,
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 3:17 E203 `t` is a word of the language; choose another name
