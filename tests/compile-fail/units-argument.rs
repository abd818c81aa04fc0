// The sine of a length.
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/5 * length^2 * der(theta)^2,
    potential = mass * gravity * length * sin(x),
)]
struct S {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "m")]
    length: f64,
}
//~ 5:47 E704 the argument of `sin` is a plain number, and this is in m; a factor in 1/m is missing
