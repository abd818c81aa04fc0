// A coordinate is no body.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(disc: (x, y, 0), radius = radius, attitude = phi),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:55 E206 `phi` is a coordinate, not a body; name the body of an `attitude(body: q)`; angles stand in `turn`
