// A name that there is not, in a picture.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(disc: (x, y), radius = radious, angle = phi),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:33 E201 `radious` is not known; did you mean `radius`?
