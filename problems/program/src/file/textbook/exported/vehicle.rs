use lagrange_core::prelude::*;

/// A vehicle with two wheels that do not slip sideways (the bicycle model) drives round a circle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m", psi: "rad"),
    define(rear = base - front),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(psi)^2,
    constraint(rear_wheel: -sin(psi) * der(x) + cos(psi) * der(y) == rear * der(psi)),
    constraint(front_wheel: -sin(psi + steer) * der(x) + cos(psi + steer) * der(y) == -front * cos(steer) * der(psi)),
    start(driving: der(x) = speed, der(y) = speed * rear * sin(steer)/(base * cos(steer)), der(psi) = speed * tan(steer)/base),
    define(
        heading = [cos(psi), sin(psi)],
        ahead = [cos(psi + steer), sin(psi + steer)],
        rear_axle = [x, y] - rear * heading,
        front_axle = [x, y] + front * heading,
    ),
    draw(path: rear_axle),
    draw(box: (rear_axle + front_axle)/2, size = (3/2 * base, base/2), angle = psi),
    draw(rod: rear_axle - base/8 * heading to rear_axle + base/8 * heading),
    draw(rod: front_axle - base/8 * ahead to front_axle + base/8 * ahead),
)]
pub struct Vehicle<T = f64> {
    #[lagrange(unit = "kg")]
    pub mass: T,
    #[lagrange(unit = "kg m^2")]
    pub inertia: T,
    #[lagrange(unit = "m")]
    pub base: T,
    #[lagrange(unit = "m")]
    pub front: T,
    #[lagrange(unit = "rad")]
    pub steer: T,
    #[lagrange(unit = "m/s")]
    pub speed: T,
}

impl Default for Vehicle {
    fn default() -> Self {
        Self {
            mass: 1000.0,
            inertia: 1500.0,
            base: 2.5,
            front: 1.2,
            steer: 0.1,
            speed: 5.0,
        }
    }
}
