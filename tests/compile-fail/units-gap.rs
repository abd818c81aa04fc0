// Friction on a gap that is an angle.
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass/5 * length^2 * der(theta)^2,
    contact(edge: theta >= 0),
    friction(grip on edge: slip = length * der(theta), static = 1/2),
)]
struct S {
    #[lagrange(unit = "kg")]
    mass: f64,
    #[lagrange(unit = "m/s^2")]
    gravity: f64,
    #[lagrange(unit = "m")]
    length: f64,
}
//~ 6:22 E707 the force of `edge` is in N m, and what presses is in N; write the gap as a distance, in m; or say where it acts: `contact(… at (px, py))`
