// A picture is in a plane or in space.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(mass: (x, y)),
    draw(path: (x, y, 0)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 6:16 E903 places have 2 coordinates here, and this has 3; a picture is in a plane, `(x, y)`, or in space, `(x, y, z)`
