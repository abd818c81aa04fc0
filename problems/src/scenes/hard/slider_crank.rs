//! A slider-crank runs through its dead centres; with equal crank and rod, also through its branching point.

use crate::drawing::{Drawing, Shape};
use lagrange_core::prelude::*;

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

impl SliderCrank {
    /// The crank, the rod and the slider.
    pub fn drawing(&self, _t: f64, q: &[f64]) -> Drawing {
        let (sin, cos) = q[0].sin_cos();
        let pin = [self.crank * cos, self.crank * sin];
        let (x, size) = (q[1], 0.2 * self.crank);
        Drawing::of([
            Shape::Bowl([0.0; 2], self.crank),
            Shape::Block(vec![
                [x - size, -size],
                [x + size, -size],
                [x + size, size],
                [x - size, size],
            ]),
            Shape::Rod(vec![[0.0; 2], pin, [x, 0.0]]),
            Shape::Pivot([0.0; 2]),
            Shape::Mass(pin),
        ])
    }
}
