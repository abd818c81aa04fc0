// Greek letters are spelt in the names of constants.
#[lagrange(
    coordinates(θ, theta),
    kinetic = mass/2 * (der(θ)^2 + der(theta)^2),
)]
struct S { mass: f64 }
//~ 3:20 E208 `theta` and `θ` become one constant, `THETA`; names of coordinates and items become constants in capitals: choose another
