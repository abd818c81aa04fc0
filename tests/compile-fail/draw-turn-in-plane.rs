// What is turned in a plane has an angle.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(box: (x, y), size = (radius, radius), turn = (0, 0, phi)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:48 E904 there is no `turn` in a plane; what is turned in a plane has an `angle`, counter-clockwise
