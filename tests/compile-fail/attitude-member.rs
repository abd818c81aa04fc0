// A misspelt member of a body.
#[lagrange(
    coordinates(x),
    attitude(body: q),
    kinetic = der(x)^2 + dot(body.bodyrate, body.body_rate),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:35 E309 `body` has no member `bodyrate`; did you mean `body_rate`?
