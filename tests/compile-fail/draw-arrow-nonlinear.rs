// The force of an arrow is linear in the multipliers.
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    contact(floor: y >= 0),
    draw(arrow: floor^2 * (0, 1) at (x, y)),
)]
struct S { mass: f64, inertia: f64, radius: f64 }
//~ 6:17 E509 the force is not linear in `floor`; the forces of contacts and constraints enter the equations linearly
