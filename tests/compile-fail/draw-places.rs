// Too few and too many places.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(rod: (x, y)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:10 E902 `rod` takes 2 places or more, not 1; places are joined by `to`
