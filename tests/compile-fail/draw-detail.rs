// A detail that a form does not have.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(mass: (x, y), radius = radius),
    draw(disc: (x, y), radus = radius),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:24 E016 `radius = radius` is not a part of `mass`; it has places only, joined by `to`
//~ 6:24 E016 `radus` is not a part of `disc`; did you mean `radius`?
