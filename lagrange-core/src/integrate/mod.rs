//! Steppers: from a state to polynomials over a step.
//!
//! The systems are q̇ = v, v̇ = a(t, q, v). Every stepper hands over a [`StepPolynomial`], from which dense output and
//! guards are read. The Taylor method has its series made elsewhere; [`taylor`] chooses its order and its steps.

pub mod control;
mod dop853;
mod dopri5;
mod hermite;
mod method;
mod polynomial;
mod rk4;
mod runge_kutta;
mod tableau;
pub mod taylor;
#[cfg(test)]
mod tests;
mod verner98;

use core::fmt;

pub use control::Tolerance;
pub use method::{Method, ParseMethodError};
pub use polynomial::StepPolynomial;
pub use runge_kutta::RungeKutta;

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

/// A step that was taken, and what it cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accepted {
    /// Its size.
    pub h: f64,
    /// Size to try next.
    pub h_next: f64,
    /// How many larger steps were tried before.
    pub rejected: usize,
    /// Evaluations of the accelerations, those of rejected steps included.
    pub evaluations: usize,
}

/// Why no step could be taken.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepError<E> {
    /// The system has no accelerations here.
    Acceleration(E),
    /// No step within the tolerance is large enough to change the time.
    TooSmall {
        /// Start of the step.
        time: f64,
        /// Its size.
        h: f64,
    },
}

impl<E: fmt::Display> fmt::Display for StepError<E> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Acceleration(error) => error.fmt(f),
            Self::TooSmall { time, h } => write!(
                f,
                "the step size has shrunk to {h:e} at t = {time}: the motion is singular there, or the tolerance is \
                 below rounding; ask for a larger tolerance"
            ),
        }
    }
}

impl<E: core::error::Error> core::error::Error for StepError<E> {}
