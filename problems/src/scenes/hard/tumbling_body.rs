//! A free rigid body turns about the ends of its middle axis, and keeps flipping over.

use lagrange_macros::Lagrangian;

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
    start(spun: body.body_rate = (nudge, rate, 0)),
    observe(rate_of_body = body.body_rate),
    // The box that has these moments of inertia, a little thicker, so that a plate is seen from the side.
    define(
        whole = inertia[0] + inertia[1] + inertia[2],
        edge = list(k in 0..3: sqrt((6 * (whole - 2*inertia[k]) + whole/625) / mass)),
    ),
    draw(box: (0, 0, 0), size = edge, attitude = body),
    draw(rod[k in 0..2]: (2*k - 1) * edge[1]/2 * body.axes[1] to (2*k - 1) * 3/5*edge[1] * body.axes[1]),
    draw(path: edge[0]/2 * body.axes[0] + edge[1]/2 * body.axes[1] + edge[2]/2 * body.axes[2]),
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
    /// Mass, kg; it says only how large the body is drawn.
    #[lagrange(unit = "kg", symbol = "m")]
    pub mass: T,
}

impl Default for TumblingBody {
    fn default() -> Self {
        Self {
            inertia: [1.0, 2.0, 3.0],
            rate: 2.0,
            nudge: 0.01,
            mass: 1.0,
        }
    }
}
