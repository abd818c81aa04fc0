// A place is in metres.
#[lagrange(
    coordinates(x: "m", y: "m", phi: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(mass: (x, phi)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
