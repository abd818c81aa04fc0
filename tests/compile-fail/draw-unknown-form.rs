// A form that there is not.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(disk: (x, y), radius = radius),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:10 E901 `disk` is not the name of a form; did you mean `disc`?
