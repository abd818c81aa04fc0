// An arrow of nothing that has a name.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(arrow: (0, -mass) at (x, y)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:10 E018 `arrow` has no name; add `name = …`
