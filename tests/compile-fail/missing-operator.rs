// Products need their sign.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    observe(a = 2 x, b = x y, c = (x)(y), d = sin x),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:19 E026 an operator is missing before `x`; a product is written with `*`; what has a unit is a parameter, and an angle a plain number
//~ 6:28 E026 an operator is missing before `y`; a product is written with `*`
//~ 6:38 E026 an operator is missing before `(`; a product is written with `*`
//~ 6:51 E026 an operator is missing before `x`; arguments stand in parentheses: `sin(…)`
