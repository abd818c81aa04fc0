//! A slider-crank runs through its dead centres; with equal crank and rod, also through its branching point.

use lagrange_macros::Lagrangian;

/// A crank with a flywheel drives a slider through a massless rod.
///
/// At the dead centres (θ = 0, π) the slider stands while the crank turns. With rod and crank of equal length there is
/// more: where the slider passes the crank's axle the linkage could fold, and the condition's gradient vanishes there. The
/// motion goes straight through.
///
/// What to expect: without gravity ½ (J + m x′(θ)²) θ̇² is constant, and the time of a turn is a quadrature; with equal
/// lengths x = 2 r cos θ.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta: "rad", x: "m"),
    kinetic = inertia/2 * der(theta)^2 + mass/2 * der(x)^2,
    constraint(rod: (x - crank * cos(theta))^2 + (crank * sin(theta))^2 == rod_length^2),
    start(spun: x = crank + rod_length, der(theta) = rate),
    draw(bowl: (0, 0), radius = crank),
    draw(box: (x, 0), size = (2/5*crank, 2/5*crank)),
    draw(rod: (0, 0) to crank * (cos(theta), sin(theta)) to (x, 0)),
    draw(pivot: (0, 0)),
    draw(mass: crank * (cos(theta), sin(theta))),
)]
pub struct SliderCrank<T = f64> {
    /// Moment of inertia of crank and flywheel, kg m².
    #[lagrange(unit = "kg m^2", domain = "positive", symbol = "I")]
    pub inertia: T,
    /// Mass of the slider, kg.
    #[lagrange(unit = "kg", domain = "positive", symbol = "m")]
    pub mass: T,
    /// Length of the crank, m.
    #[lagrange(unit = "m", symbol = "r")]
    pub crank: T,
    /// Length of the rod, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub rod_length: T,
    /// Rate of the crank at the start, rad/s.
    #[lagrange(unit = "rad/s", symbol = "omega")]
    pub rate: T,
}

impl Default for SliderCrank {
    fn default() -> Self {
        Self {
            inertia: 0.02,
            mass: 0.5,
            crank: 0.1,
            rod_length: 0.25,
            rate: 20.0,
        }
    }
}
