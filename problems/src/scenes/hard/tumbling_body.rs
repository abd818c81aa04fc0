//! A free rigid body turns about the ends of its middle axis, and keeps flipping over.

use crate::space::{Pose, Solid, Space};
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
    #[lagrange(unit = "kg m^2", domain = "positive", symbol = "I")]
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
    /// The box of mass 1 that has these moments of inertia, the ends of its middle axis, and the path of a corner.
    pub fn drawing(&self, _t: f64, q: &[f64]) -> Space {
        let body = Pose::at(0.0, 0.0, 0.0).attitude(q);
        let sum: f64 = self.inertia.iter().sum();
        // Iₖ is a twelfth of the squares of the other two edges.
        let edges = self
            .inertia
            .map(|i| (6.0 * (sum - 2.0 * i)).max(0.0).sqrt());
        // A plate, whose largest moment is the sum of the others, would not be seen from its side.
        let thin = 0.02 * edges.into_iter().fold(0.0, f64::max);
        let edges = edges.map(|edge| edge.max(thin));
        let [x, y, z] = edges.map(|edge| edge / 2.0);
        let stub = |side: f64| {
            let ends = [1.0, 1.2].map(|part| body.place(0.0, side * part * y, 0.0));
            Solid::Rod(ends.into())
        };
        Space::of([
            Solid::Box(edges, body),
            stub(-1.0),
            stub(1.0),
            Solid::Trace(body.place(x, y, z)),
        ])
    }
}
