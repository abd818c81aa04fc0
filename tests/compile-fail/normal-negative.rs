// A normal force with a sign.
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    friction(grip: slip = der(x), normal = -3, static = 0.3),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 5:44 E512 friction is not negative; its sign follows from the slip: write the magnitude
