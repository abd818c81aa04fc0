// Names whose constants every system has.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(declaration: y >= 0),
    start(checks: x = 1),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:13 E209 `declaration` becomes the constant `DECLARATION`, which every system has already; choose another name
//~ 6:11 E209 `checks` becomes the constant `CHECKS`, which every system has already; choose another name
