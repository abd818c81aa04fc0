//! What the steppers ask for: accelerations, and Taylor series.

use super::{Dynamics, EvaluationError};
use crate::arithmetic::Scalar;
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
        dv.copy_from_slice(self.run_accelerations(t, q, v)?);
        Ok(())
    }

    fn jacobian(
        &mut self,
        t: S::Scalar,
        q: &[S::Scalar],
        v: &[S::Scalar],
        by_position: &mut [f64],
        by_velocity: &mut [f64],
    ) -> Result<bool, EvaluationError> {
        let n = q.len();
        let mut columns = core::mem::take(&mut self.columns);
        columns.resize(2 * n * n, S::Scalar::default());
        let outcome = Dynamics::jacobian(self, t, q, v, &mut columns);
        let (by_q, by_v) = columns.split_at(n * n);
        for (rows, columns) in [(by_position, by_q), (by_velocity, by_v)] {
            for (at, element) in rows.iter_mut().enumerate() {
                *element = columns[at % n * n + at / n].value();
            }
        }
        self.columns = columns;
        outcome.map(|()| true)
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
