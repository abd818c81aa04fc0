// A body in space keeps its size.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(sphere: (x, y, 0), radius = x),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:10 E906 the size of this `sphere` changes; a body in space keeps its size: write it in parameters alone
