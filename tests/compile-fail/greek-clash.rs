// Greek letters are spelt in the names of constants.
#[lagrange(
    coordinates(θ, theta),
    kinetic = mass/2 * (der(θ)^2 + der(theta)^2),
)]
struct S { mass: f64 }
