//! A free rigid body turns about its middle axis, and keeps flipping over.

use crate::drawing::{Drawing, Shape, aslant, axes};
use lagrange_core::prelude::*;

/// A rigid body with three different moments of inertia, free in space, its attitude by a unit quaternion.
///
/// Rotation about the middle axis is unstable: the body turns over again and again. Angles would meet their pole; four
/// coordinates with one condition have none, but their mass matrix is singular.
///
/// What to expect: the rates about the body's axes are Jacobi's elliptic functions (Whittaker 1904, section 69), the
/// angular momentum stays fixed in space, and after each period the attitude has turned about it by a quadrature.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    attitude(body: q),
    kinetic = sum(k in 0..3: inertia[k]/2 * body.body_rate[k]^2),
    start(spun: q[0] = 1, der(q[1]) = nudge/2, der(q[2]) = rate/2),
    observe(rate_of_body = body.body_rate),
)]
pub struct TumblingBody<T = f64> {
    /// Principal moments of inertia, kg m², ascending.
    #[lagrange(unit = "kg m^2", symbol = "I")]
    pub inertia: [T; 3],
    /// Rate about the middle axis at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub rate: T,
    /// Rate about the first axis at the start, rad/s.
    #[lagrange(unit = "rad/s")]
    pub nudge: T,
}

impl Default for TumblingBody {
    fn default() -> Self {
        Self {
            inertia: [1.0, 2.0, 3.0],
            rate: 2.0,
            nudge: 0.01,
        }
    }
}

impl TumblingBody {
    /// The box of mass 1 that has these moments of inertia, and the path of a corner.
    pub fn drawing(&self, _t: f64, q: &[f64]) -> Drawing {
        let body = axes(q);
        let sum: f64 = self.inertia.iter().sum();
        // Iₖ is a third of the squares of the other two half edges.
        let half = self
            .inertia
            .map(|i| (1.5 * (sum - 2.0 * i)).max(0.0).sqrt());
        let corner = |signs: [f64; 3]| {
            let place = |k: usize| (0..3).map(|i| signs[i] * half[i] * body[i][k]).sum();
            aslant([place(0), place(1), place(2)])
        };
        let face = |side: f64| {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            corners.map(|[a, b]| corner([a, b, side]))
        };
        let (lower, upper) = (face(-1.0), face(1.0));
        let edge = |k: usize| Shape::Rod(vec![lower[k], upper[k]]);
        Drawing::of([
            Shape::Trace(upper[2]),
            Shape::Block(lower.to_vec()),
            edge(0),
            edge(1),
            edge(2),
            edge(3),
            Shape::Block(upper.to_vec()),
        ])
    }
}
