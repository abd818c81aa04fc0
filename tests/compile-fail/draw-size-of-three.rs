// A rectangle has two edges.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(box: (x, y), size = (radius, radius, radius)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:30 E905 `size` takes 2 numbers, not 3; write them as a list, `(a, b)` in a plane and `(a, b, c)` in space
