//! Steppers: from a state to polynomials over a step.
//!
//! The systems are q̇ = v, v̇ = a(t, q, v). Every stepper hands over a [`StepPolynomial`], from which dense output and
//! guards are read. The Taylor method has its series made elsewhere; [`taylor`] chooses its order and its steps.

pub mod control;
mod polynomial;
pub mod taylor;

pub use control::Tolerance;
pub use polynomial::StepPolynomial;

/// v̇ = a(t, q, v): what Runge–Kutta methods integrate together with q̇ = v.
pub trait Acceleration<T> {
    /// Why an acceleration could not be had.
    type Error;

    /// Writes the accelerations at time `t`, positions `q` and velocities `v` into `dv`; all have one element per coordinate.
    ///
    /// # Errors
    /// Whatever keeps the system from having accelerations there.
    fn acceleration(&mut self, t: T, q: &[T], v: &[T], dv: &mut [T]) -> Result<(), Self::Error>;
}
