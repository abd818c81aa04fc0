// A start that turns or spins a body by vectors of other lengths.
#[lagrange(
    coordinates(x),
    attitude(body: q),
    kinetic = der(x)^2 + dot(body.body_rate, body.body_rate),
    start(a: body.turn = (1, 0)), start(b: body.body_rate = 1), start(c: body.space_rate[3] = 1), start(d: body.body_rate = (1, 0)),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:26 E905 `turn` takes 3 numbers, not 2; write them as a list, `(a, b)` in a plane and `(a, b, c)` in space
//~ 6:61 E303 a single value where a list is expected; `body.body_rate` has 3 elements: `body.body_rate[k in 0..3] = …`
//~ 6:90 E305 the index 3 is outside 0..3; indices start at the lower bound, and the upper bound is left out
//~ 6:125 E304 lists of 2 and 3 elements do not fit; both sides need as many elements
