// Definitions in a circle.
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * length^2 * der(theta)^2,
    potential = -mass * gravity * length * cos(theta),
    define(a = b, b = a),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 6:23 E205 `a` is defined through itself; break the circle: its value is needed to find its value
