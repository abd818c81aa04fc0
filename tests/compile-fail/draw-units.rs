// A place is in metres.
#[lagrange(
    coordinates(x: "m", y: "m", phi: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    draw(mass: (x, phi)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 5:20 E704 a place in a picture is in m, and this is a plain number; a factor in m is missing
