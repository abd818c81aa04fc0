// A disc without a radius.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(disc: (x, y)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:10 E018 `disc` has no radius; add `radius = …`
