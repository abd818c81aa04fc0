// The index of a list hides a field.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(rod: list(mass in 0..3: (x, y))),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:20 E204 the index `mass` hides the parameter of that name; choose another letter
