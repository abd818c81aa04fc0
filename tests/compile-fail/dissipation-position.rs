// A dissipation without a velocity.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    dissipation(oil: x^2),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:22 E506 the dissipation depends on no velocity; a dissipation is half a power: `c/2 * der(x)^2`
