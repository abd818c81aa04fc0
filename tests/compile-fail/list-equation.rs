// Two points that are one: an equation for each coordinate
#[lagrange(
    coordinates(x, y, theta),
    define(tip = [length * sin(theta), -length * cos(theta)], bob = [x, y]),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(joint: bob == tip),
)]
struct S { mass: f64, gravity: f64, length: f64 }
//~ 7:23 E302 a list of 2 where a single value is expected; write an equation for each element, `joint[k in 0..2]: bob[k] == tip[k]`
