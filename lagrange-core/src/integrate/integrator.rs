//! Every method that integrates [`Acceleration`]s, behind one set of functions.

use super::control::Tolerance;
use super::{
    Acceleration, Accepted, Gauss, Method, Radau, RungeKutta, Start, StepError, StepPolynomial,
};
use crate::arithmetic::Scalar;

/// A method other than Taylor's, and its memory.
#[derive(Clone, Debug)]
pub enum Integrator<T> {
    /// Explicit.
    RungeKutta(RungeKutta<T>),
    /// Implicit, for stiff systems.
    Radau(Box<Radau<T>>),
    /// Symplectic.
    Gauss(Gauss<T>),
}

impl<T: Scalar> Integrator<T> {
    /// `method` for `coordinates` coordinates. `None` for Taylor series, and for what begins with them: they need more than accelerations.
    pub fn new(method: Method, coordinates: usize) -> Option<Self> {
        match method {
            Method::Radau5 => Some(Self::Radau(Box::new(Radau::new(coordinates)))),
            Method::Gauss6 { step } => Some(Self::Gauss(Gauss::new(step, coordinates))),
            explicit => RungeKutta::new(explicit, coordinates).map(Self::RungeKutta),
        }
    }

    /// Degree of the polynomials that [`Self::step`] writes.
    pub fn degree(&self) -> usize {
        match self {
            Self::RungeKutta(method) => method.degree(),
            Self::Radau(_) => Radau::<T>::DEGREE,
            Self::Gauss(_) => Gauss::<T>::DEGREE,
        }
    }

    /// Whether it is explicit and chooses its steps by their errors.
    pub fn is_explicit_and_adaptive(&self) -> bool {
        matches!(self, Self::RungeKutta(method) if method.is_adaptive())
    }

    /// Whether it is implicit and chooses its steps, so that motions that are damped fast do not bound them.
    pub fn is_stiff(&self) -> bool {
        matches!(self, Self::Radau(_))
    }

    /// Whether the end of a step is of a higher order than what lies before it.
    pub fn is_best_at_end(&self) -> bool {
        matches!(self, Self::Radau(_))
    }

    /// Forgets earlier steps: the system or its state is another one from here on.
    pub fn restart(&mut self) {
        match self {
            Self::RungeKutta(method) => method.restart(),
            Self::Radau(method) => method.restart(),
            Self::Gauss(method) => method.restart(),
        }
    }

    /// A first step size, at most `h_max`.
    ///
    /// # Errors
    /// The system has no accelerations at the start.
    pub fn first_step<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        h_max: f64,
        tolerance: Tolerance,
    ) -> Result<f64, StepError<A::Error>> {
        match self {
            Self::RungeKutta(method) => method.first_step(system, from, h_max, tolerance),
            Self::Radau(method) => method.first_step(system, from, h_max, tolerance),
            Self::Gauss(_) => Ok(h_max),
        }
    }

    /// One step from a state, of at most `h_try` > 0 within `tolerance` (which methods with fixed steps ignore), with
    /// dense output into `out`. The step's result is what `out` has at s = 1.
    ///
    /// # Errors
    /// See [`StepError`].
    pub fn step<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        h_try: f64,
        tolerance: Tolerance,
        out: &mut StepPolynomial<T>,
    ) -> Result<Accepted, StepError<A::Error>> {
        match self {
            Self::RungeKutta(method) => method.step(system, from, h_try, tolerance, out),
            Self::Radau(method) => method.step(system, from, h_try, tolerance, out),
            Self::Gauss(method) => method.step(system, from, h_try, out),
        }
    }
}
