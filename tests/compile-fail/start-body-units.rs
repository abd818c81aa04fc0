// A start that spins a body by a length.
#[lagrange(
    attitude(body: q),
    kinetic = inertia * dot(body.body_rate, body.body_rate),
    start(a: body.body_rate = (0, length, 0)),
    start(b: body.turn = ((0, 0, 1), (length, 0, 0))),
)]
struct S {
    #[lagrange(unit = "kg m^2")]
    inertia: f64,
    #[lagrange(unit = "m")]
    length: f64,
}
//~ 5:35 E704 `body.body_rate` is in 1/s, and this is in m; a factor in 1/(m s) is missing
//~ 6:39 E704 `body.turn` is a plain number, and this is in m; a factor in 1/m is missing
