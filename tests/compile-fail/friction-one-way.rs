// A friction that holds has one strength.
#[lagrange(
    coordinates(a, b),
    kinetic = inertia/2 * (der(a)^2 + der(b)^2),
    friction(clutch: slip = der(b) - der(a), limit = if(slip >= 0, 0, hold)),
)]
struct S { inertia: f64, hold: f64 }
//~ 5:54 E519 this friction is stronger one way than the other, and at rest it has one strength; one of a against a positive slip s and b against a negative one is `limit = (a + b)/2` beside `force(push: (b - a)/2 along s)`; a one-way clutch has a = 0
