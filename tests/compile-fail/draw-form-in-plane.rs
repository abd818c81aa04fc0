// A ball is in space.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(sphere: (x, y), radius = radius),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:10 E904 there is no `sphere` in a plane; draw a `disc`, or give places three coordinates
