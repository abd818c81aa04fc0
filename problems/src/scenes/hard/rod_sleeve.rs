//! A sleeve on a turning rod: slip and normal force vanish together.

use lagrange_macros::Lagrangian;

/// A sleeve slides on a rod that turns at a constant rate in a level plane.
///
/// What to expect: N = 2 m ω ṙ, so that r̈ + 2 μ ω ṙ − ω² r = 0 whichever way it slips, r = a exp(k₁t) + b exp(k₂t) with
/// k = ω (−μ ± √(μ² + 1)). Pushed inwards it turns where ṙ = 0, and there the rod does not press at all: stick is impossible,
/// however rough the rod. From rest the normal force is zero at the start.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x: "m", y: "m"),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    constraint(rod: y * cos(rate * t) == x * sin(rate * t)),
    friction(rub on rod: slip = der(x) * cos(rate * t) + der(y) * sin(rate * t), static = mu, kinetic = mu),
    start(inwards: x = distance, der(x) = -speed, der(y) = rate * distance),
    observe(r = x * cos(rate * t) + y * sin(rate * t)),
    draw(path: (x, y)),
    draw(rod: -3/2*distance * (cos(rate*t), sin(rate*t)) to 3/2*distance * (cos(rate*t), sin(rate*t))),
    draw(mass: (x, y)),
    draw(arrow: rod * (-sin(rate*t), cos(rate*t)) at (x, y)),
    draw(arrow: rub * (cos(rate*t), sin(rate*t)) at (x, y)),
)]
pub struct RodSleeve<T = f64> {
    /// Mass, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Rate ω of the rod, rad/s.
    #[lagrange(unit = "rad/s", symbol = "omega")]
    pub rate: T,
    /// Coefficient of friction.
    #[lagrange(unit = "1", symbol = "mu")]
    pub mu: T,
    /// Distance from the axle at the start, m.
    #[lagrange(unit = "m")]
    pub distance: T,
    /// Speed inwards at the start, m/s.
    #[lagrange(unit = "m/s", symbol = "v_0")]
    pub speed: T,
}

impl Default for RodSleeve {
    fn default() -> Self {
        Self {
            mass: 0.3,
            rate: 2.0,
            mu: 0.4,
            distance: 0.5,
            speed: 0.8,
        }
    }
}
