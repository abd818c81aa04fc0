// A start that sets what follows from others, or is no body.
#[lagrange(
    coordinates(x),
    attitude(body: q),
    kinetic = der(x)^2 + dot(body.body_rate, body.body_rate),
    start(a: body.axes = (1, 0, 0)), start(b: body.rate = (1, 0, 0)), start(c: x.turn = (1, 0, 0)), start(d: bdy.turn = (1, 0, 0)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:19 E309 `body` has no member `axes`; a start sets turn, body_rate, space_rate
//~ 6:52 E309 `body` has no member `rate`; a start sets turn, body_rate, space_rate
//~ 6:82 E309 `x` has no member `turn`; members belong to a body of `attitude`
//~ 6:110 E201 `bdy` is not known; did you mean `body`?
