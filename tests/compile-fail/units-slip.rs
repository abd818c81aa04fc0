// A slip that is not a velocity.
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/5 * length^2 * der(theta)^2,
    contact(floor: y >= length),
    friction(grip on floor: slip = der(x) - der(theta), static = 1/2),
)]
struct S {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "m")]
    length: f64,
}
//~ 6:45 E705 adds 1/s to m/s; a factor in m is missing
