//! A free rigid body turns about its middle axis, and keeps flipping over.

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
