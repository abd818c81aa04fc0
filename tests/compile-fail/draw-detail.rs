// A detail that a form does not have.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(mass: (x, y), radius = radius),
    draw(disc: (x, y), radus = radius),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
