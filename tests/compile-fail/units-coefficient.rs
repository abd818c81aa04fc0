// A coefficient of friction that is a force.
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/5 * length^2 * der(theta)^2,
    contact(floor: y >= length),
    friction(grip on floor: slip = der(x), static = mass * gravity),
)]
struct S {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "m")]
    length: f64,
}
//~ 6:53 E704 a coefficient of friction is a plain number, and this is in N; a factor in s²/(kg m) is missing
