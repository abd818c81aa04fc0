//! Dense output from both ends of a step, for methods without their own: positions by the quintic through position,
//! velocity and acceleration at both ends, velocities by its derivative. Errors are O(h⁶) and O(h⁵).

use crate::arithmetic::Scalar;

/// Degree of the positions' polynomial.
pub(super) const DEGREE: usize = 5;

/// Writes the coefficients of sᵏ from (q, v, a) at s = 0 and (Δq, Δv, a) at s = 1, per unit of time; h is the step. What a short step changes of a large q
/// is far better known than the difference of its ends.
pub(super) fn quintic<T: Scalar>(h: T, start: [T; 3], end: [T; 3], q: &mut [T], v: &mut [T]) {
    let number = T::from_f64;
    let [q0, v_start, a0] = start;
    let [change_q, change_v, a1] = end;
    let v0 = h * v_start;
    let (a0, a1) = (h * h * a0, h * h * a1);
    // What the parabola from s = 0 leaves to be made up at s = 1.
    let dq = change_q - v0 - number(0.5) * a0;
    let dv = h * change_v - a0;
    let da = a1 - a0;
    let coefficients = [
        q0,
        v0,
        number(0.5) * a0,
        number(10.0) * dq - number(4.0) * dv + number(0.5) * da,
        number(-15.0) * dq + number(7.0) * dv - da,
        number(6.0) * dq - number(3.0) * dv + number(0.5) * da,
    ];
    q.copy_from_slice(&coefficients);
    for (k, v) in v[..DEGREE].iter_mut().enumerate() {
        *v = number((k + 1) as f64) * coefficients[k + 1] / h;
    }
    v[0] = v_start;
    v[DEGREE] = T::zero();
}
