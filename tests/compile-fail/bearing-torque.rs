// What presses is a force, and each name is told its own.
#[lagrange(
    coordinates(x: "m", y: "m", theta: "rad"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    constraint(wall: y == 0),
    constraint(upright: theta == 0),
    friction(rub on (upright, wall): slip = der(x), static = 0.3),
)]
struct S { #[lagrange(unit = "kg")] mass: f64, #[lagrange(unit = "kg m^2")] inertia: f64 }
//~ 7:22 E707 the force of `upright` is in N m, and what presses is in N; write both sides of the constraint as distances, in m, or as velocities, in m/s
