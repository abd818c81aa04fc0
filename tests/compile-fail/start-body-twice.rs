// A start that turns or spins a body twice.
#[lagrange(
    coordinates(x),
    attitude(body: q),
    kinetic = der(x)^2 + dot(body.body_rate, body.body_rate),
    start(a: body.turn = (1, 0, 0), q[0] = 1), start(b: body.body_rate[0] = 1, body.body_rate = (1, 0, 0)), start(c: body.space_rate = (1, 0, 0), body.body_rate = (1, 0, 0)), start(d: body.turn = (1, 0, 0), body.turn = (1, 0, 0)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:14 E023 `body.turn` and `q[0]` exclude each other; both say how the body moves; keep one
//~ 6:85 E510 `body.body_rate[0]` is given twice; keep one
//~ 6:118 E023 `body.body_rate` and `body.space_rate` exclude each other; both say how the body moves; keep one
//~ 6:213 E510 `body.turn` is given twice; keep one
