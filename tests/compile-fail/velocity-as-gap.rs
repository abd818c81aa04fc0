// A velocity of one sign is no contact.
#[lagrange(
    coordinates(a, b),
    kinetic = inertia/2 * (der(a)^2 + der(b)^2),
    contact(clutch: der(b) >= der(a)),
)]
struct S { inertia: f64, hold: f64 }
//~ 5:21 E401 a gap depends on positions only, and `der(b)` is a velocity; a velocity s that has one sign only, as of a one-way clutch that holds H, is `force(push: H/2 along s)` with `friction(clutch: slip = s, limit = H/2)`
