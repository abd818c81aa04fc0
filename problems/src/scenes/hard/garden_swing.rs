//! A garden swing in space: a loop of four hinges, three of whose conditions are too many.

use lagrange_macros::Lagrangian;

/// A seat on two equal hangers, all three of them bodies in space, and each of the four joints a hinge with five conditions.
///
/// With the three unit quaternions these are 23 conditions for 21 coordinates, and yet it swings: three conditions follow from the others. A
/// small way off the conditions, at the end of a step, they seem to be independent, and forces without bounds would bring the state back.
///
/// What to expect: the seat does not turn, and the hangers swing as one physical pendulum with the period 2π/(ω₀ agm(1, cos ½θ₀)),
/// ω₀² = (hanger + seat) g l/(2 I + ½ hanger l² + seat l²), I the inertia of a hanger about its middle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    attitude(left: p), attitude(bench: q), attitude(right: r),
    coordinates(a[3]: "m", b[3]: "m", c[3]: "m"),
    define(
        left_top = a + length/2 * left.axes[2],
        left_end = a - length/2 * left.axes[2],
        right_top = c + length/2 * right.axes[2],
        right_end = c - length/2 * right.axes[2],
        bench_left = b - span/2 * bench.axes[0],
        bench_right = b + span/2 * bench.axes[0],
    ),
    kinetic = sum(i in 0..3: hanger/2 * (der(a[i])^2 + der(c[i])^2) + seat/2 * der(b[i])^2
        + inertia/2 * (left.body_rate[i]^2 + right.body_rate[i]^2 + bench.body_rate[i]^2)),
    potential = gravity * (hanger * (a[2] + c[2]) + seat * b[2]),
    constraint(left_x: left_top[0] == -span/2),
    constraint(left_y: left_top[1] == 0),
    constraint(left_z: left_top[2] == 0),
    constraint(left_hinge[i in 0..2]: left.axes[1][2*i] == 0),
    constraint(left_joint[i in 0..3]: left_end[i] == bench_left[i]),
    constraint(left_pin[i in 0..2]: dot(left.axes[1], bench.axes[2*i]) == 0),
    constraint(right_joint[i in 0..3]: right_end[i] == bench_right[i]),
    constraint(right_pin[i in 0..2]: dot(right.axes[1], bench.axes[2*i]) == 0),
    constraint(right_x: right_top[0] == span/2),
    constraint(right_y: right_top[1] == 0),
    constraint(right_z: right_top[2] == 0),
    constraint(right_hinge[i in 0..2]: right.axes[1][2*i] == 0),
    start(drawn:
        p[0] = cos(start_angle/2), p[2] = sin(start_angle/2), q[0] = 1,
        r[0] = cos(start_angle/2), r[2] = sin(start_angle/2),
        a[0] = -span/2 - length/2 * sin(start_angle), a[2] = -length/2 * cos(start_angle),
        b[0] = -length * sin(start_angle), b[2] = -length * cos(start_angle),
        c[0] = span/2 - length/2 * sin(start_angle), c[2] = -length/2 * cos(start_angle)),
    draw(rod: (-span/2, 0, 0) to left_end),
    draw(rod: (span/2, 0, 0) to right_end),
    draw(box: b, size = [span, span/3, span/20], attitude = bench),
    draw(pivot: (-span/2, 0, 0)),
    draw(pivot: (span/2, 0, 0)),
    emit = data,
)]
pub struct GardenSwing<T = f64> {
    /// Mass of a hanger, kg.
    #[lagrange(unit = "kg", domain = "positive")]
    pub hanger: T,
    /// Mass of the seat, kg.
    #[lagrange(unit = "kg", domain = "positive")]
    pub seat: T,
    /// Moment of inertia of each body about any axis through its middle, kg m².
    #[lagrange(unit = "kg m^2", domain = "positive", symbol = "I")]
    pub inertia: T,
    /// Length of the hangers, m.
    #[lagrange(unit = "m", domain = "positive", symbol = "l")]
    pub length: T,
    /// Distance of the hangers, m.
    #[lagrange(unit = "m", domain = "positive")]
    pub span: T,
    /// Gravitational acceleration, m/s².
    #[lagrange(unit = "m/s^2", symbol = "g")]
    pub gravity: T,
    /// Angle θ₀ of the hangers at the start, rad from the vertical.
    #[lagrange(unit = "rad")]
    pub start_angle: T,
}

impl Default for GardenSwing {
    fn default() -> Self {
        Self {
            hanger: 4.0,
            seat: 30.0,
            inertia: 0.8,
            length: 1.5,
            span: 1.2,
            gravity: 9.81,
            start_angle: 1.0,
        }
    }
}
