//! What the steppers ask for: accelerations.

use super::{Dynamics, EvaluationError};
use crate::arithmetic::Scalar;
use crate::integrate::Acceleration;

impl<T: Scalar> Acceleration<T> for Dynamics<T> {
    type Error = EvaluationError;

    fn acceleration(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        dv: &mut [T],
    ) -> Result<(), EvaluationError> {
        self.run_accelerations(t, q, v, dv)
    }

    fn jacobian(
        &mut self,
        t: T,
        q: &[T],
        v: &[T],
        by_position: &mut [f64],
        by_velocity: &mut [f64],
    ) -> Result<bool, EvaluationError> {
        let n = q.len();
        let mut columns = core::mem::take(&mut self.columns);
        columns.resize(2 * n * n, T::default());
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
