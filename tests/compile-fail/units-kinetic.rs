// A velocity that was not squared.
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/5 * length^2 * der(theta),
    potential = mass * gravity * y,
)]
struct S {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "m")]
    length: f64,
}
//~ 4:48 E705 adds kg m²/s to J; is a `der(…)` missing?
