//! What the steppers ask for: accelerations, and Taylor series.

use super::{Dynamics, EvaluationError};
use crate::integrate::{Acceleration, taylor};
use crate::system::System;

impl<S: System> Acceleration<S::Scalar> for Dynamics<S> {
    type Error = EvaluationError;

    fn acceleration(
        &mut self,
        t: S::Scalar,
        q: &[S::Scalar],
        v: &[S::Scalar],
        dv: &mut [S::Scalar],
    ) -> Result<(), EvaluationError> {
        self.value(t, q, v)?;
        dv.copy_from_slice(Dynamics::acceleration(self));
        Ok(())
    }
}

impl<S: System> taylor::Series<S::Scalar> for Dynamics<S> {
    fn coordinates(&self) -> usize {
        S::DESCRIPTION.coordinates.len()
    }

    fn position(&self, i: usize) -> &[S::Scalar] {
        self.position_series(i)
    }

    fn velocity(&self, i: usize) -> &[S::Scalar] {
        self.velocity_series(i)
    }
}
