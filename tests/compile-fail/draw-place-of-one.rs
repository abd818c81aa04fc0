// A place that is no list.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(mass: x),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:16 E303 a single value where a list is expected; a place has two coordinates in a plane, `(x, y)`, and three in space
