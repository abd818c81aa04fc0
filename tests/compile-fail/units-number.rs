// A constant of nature as a bare number.
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/5 * length^2 * der(theta)^2,
    potential = 9.81 * mass * y,
)]
struct S {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "m")]
    length: f64,
}
//~ 5:17 E704 a potential energy is in J, and this is in kg m; `9.81` is a plain number: make it a field with `#[lagrange(unit = "m/s²")]`
