// Two sources of the normal force.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x), static = 1, normal = 5),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:22 E023 `on` and `normal` exclude each other; keep one source of the normal force
