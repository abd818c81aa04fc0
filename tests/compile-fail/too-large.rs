// Every coordinate knows every other: 330 links.
#[lagrange(
    coordinates(theta[330]),
    define(
        x[k in 0..330] = sum(i in 0..k+1: length * sin(theta[i])),
        y[k in 0..330] = sum(i in 0..k+1: -length * cos(theta[i])),
    ),
    kinetic = sum(k in 0..330: mass/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..330: mass * gravity * y[k]),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 11:8 E607 the equations of `S` outgrow 1000000 operands; declare fewer elements; or give each body coordinates of its own and tie them with `constraint`: then each equation knows its neighbours only
