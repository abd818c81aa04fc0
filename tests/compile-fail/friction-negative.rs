// Friction with a sign.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(grip on floor: slip = der(x), static = -0.3),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:53 E512 friction is not negative; its sign follows from the slip: write the magnitude
