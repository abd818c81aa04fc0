// An arrow without a place.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    force(drive: x = radius),
    draw(arrow: drive * (1, 0)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 6:17 E018 `arrow` has no place; add `at (x, y)`
