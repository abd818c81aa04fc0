// A slip that is the rate of an angle.
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/5 * length^2 * der(theta)^2,
    contact(floor: y >= length),
    friction(grip on floor: slip = der(theta), static = 1/2),
)]
struct S {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "m")]
    length: f64,
}
//~ 6:36 E704 a slip is in m/s, and this is in 1/s; a factor in m is missing
