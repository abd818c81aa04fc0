//! A ball rolls on a turning table, on a circle that is not the table's.

use lagrange_macros::Lagrangian;

/// A solid ball rolls without slipping on a table that turns at a constant rate.
///
/// The condition ties the ball's velocity and spin to the table's, which does work: energy is not conserved, and the
/// ball's orientation never comes back.
///
/// What to expect (Routh 1884): v̇ = (2/7) Ω × v, so the ball runs on a circle at 2/7 of the table's rate, about
/// a centre that depends on where and how it was put down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    attitude(ball: q),
    kinetic = mass/2 * (der(x)^2 + der(y)^2)
        + (2/5 * mass * radius^2)/2 * sum(k in 0..3: ball.body_rate[k]^2),
    constraint(rolling_x: der(x) - radius * ball.space_rate[1] == -rate * y),
    constraint(rolling_y: der(y) + radius * ball.space_rate[0] == rate * x),
    start(put:
        x = start_x, der(y) = start_speed,
        ball.space_rate[0] = (rate * start_x - start_speed) / radius),
    // The table is larger than the circle that the ball runs on.
    draw(floor: -radius),
    draw(disc: (0, 0, -radius/4),
        radius = abs(start_x) + 7 * abs(start_speed) / sqrt(rate^2 + (start_speed/start_x)^2),
        height = radius/2, turn = (0, 0, rate * t)),
    draw(sphere: (x, y, radius), radius = radius, attitude = ball),
    draw(path: (x, y, 0)),
    draw(arrow: (rolling_x, rolling_y, 0) at (x, y, 0), name = rolling),
    emit = data,
)]
pub struct Turntable<T = f64> {
    /// Mass of the ball, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Radius of the ball, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "R")]
    pub radius: T,
    /// Rate Ω of the table, rad/s.
    #[lagrange(unit = "rad/s", symbol = "Omega")]
    pub rate: T,
    /// Distance from the axle at the start, m.
    #[lagrange(unit = "m")]
    pub start_x: T,
    /// Speed at the start, across the radius, m/s.
    #[lagrange(unit = "m/s", symbol = "v_0")]
    pub start_speed: T,
}

impl Default for Turntable {
    fn default() -> Self {
        Self {
            mass: 0.2,
            radius: 0.05,
            rate: 3.0,
            start_x: 0.5,
            start_speed: 0.4,
        }
    }
}
