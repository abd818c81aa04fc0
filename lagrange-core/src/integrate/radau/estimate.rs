//! The error of a step, the size of the next one, and the dense output.

use super::{COLLOCATION, ESTIMATE, MAX_ITERATIONS, REAL, Radau};
use crate::arithmetic::Scalar;
use crate::integrate::control::error_norm;
use crate::integrate::{Acceleration, StepPolynomial, Tolerance};

impl<T: Scalar> Radau<T> {
    /// Step size from the error, predicted from the last two (Gustafsson 1994).
    pub(super) fn next_step(&self, h: f64, error: f64, iterations: usize) -> f64 {
        let safety =
            0.9 * (2 * MAX_ITERATIONS + 1) as f64 / (2 * MAX_ITERATIONS + iterations) as f64;
        let error = error.max(1e-10);
        let mut factor = safety * error.powf(-0.25);
        if let Some((last, before)) = self.memory.accepted.filter(|_| error <= 1.0) {
            let predicted = safety * (h / last) * (before / (error * error)).powf(0.25);
            factor = factor.min(predicted);
        }
        h * factor.clamp(0.125, 5.0)
    }

    /// Error of the step in units of the tolerance.
    pub(super) fn estimate<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        t: T,
        h: f64,
        tolerance: Tolerance,
        again: bool,
        evaluations: &mut usize,
    ) -> Result<f64, A::Error> {
        let n = self.coordinates;
        self.trial[1].copy_from_slice(&self.start[1]);
        self.trial[2].copy_from_slice(&self.start[2]);
        let error = self.filtered_error(h, tolerance);
        if error < 1.0 || !(again || self.memory.accepted.is_none()) {
            return Ok(error);
        }
        // Of stiff components the first estimate is far too large; a second filter takes them out.
        let [q, v, a] = &mut self.trial;
        for i in 0..n {
            q[i] = self.start[0][i] + self.error[0][i];
            v[i] = self.start[1][i] + self.error[1][i];
        }
        *evaluations += 1;
        system.acceleration(t, q, v, a)?;
        Ok(self.filtered_error(h, tolerance))
    }

    /// (I − h γ₀ J)⁻¹ (h γ₀ f + Σ eᵢ zᵢ) with f in `trial`, and its norm.
    fn filtered_error(&mut self, h: f64, tolerance: Tolerance) -> f64 {
        let n = self.coordinates;
        let real = T::from_f64(h * REAL);
        let [error_q, error_v] = &mut self.error;
        for i in 0..n {
            error_q[i] = real * self.trial[1][i] + Self::weighted(ESTIMATE, &self.z, n, i);
            error_v[i] = real * self.trial[2][i] + Self::weighted(ESTIMATE, &self.w, n, i);
        }
        for (row, error) in self.jacobian[0]
            .chunks_exact(n.max(1))
            .zip(error_v.iter_mut())
        {
            for (by_position, error_q) in row.iter().zip(&*error_q) {
                *error += real * T::from_f64(*by_position) * *error_q;
            }
        }
        self.real.solve(error_v);
        for (q, v) in error_q.iter_mut().zip(&*error_v) {
            *q += real * *v;
        }
        let [end_q, end_v] = &self.end.1;
        let q = error_norm(error_q, &self.start[0], end_q, tolerance);
        let v = error_norm(error_v, &self.start[1], end_v, tolerance);
        (0.5 * (q * q + v * v)).sqrt()
    }

    /// The collocation polynomial; the state at its end is the step's result.
    pub(super) fn write(&mut self, t: T, h: f64, out: &mut StepPolynomial<T>) {
        let n = self.coordinates;
        out.set_degree(Self::DEGREE);
        (out.t, out.h) = (t, T::from_f64(h));
        for i in 0..n {
            let (q, v) = out.rows_mut(i);
            (q[0], v[0]) = (self.start[0][i], self.start[1][i]);
            for (k, row) in COLLOCATION.into_iter().enumerate() {
                q[k + 1] = Self::weighted(row, &self.z, n, i);
                v[k + 1] = Self::weighted(row, &self.w, n, i);
            }
        }
        let [end_q, end_v] = &mut self.end.1;
        out.close_onto(end_q, end_v);
        out.state_into(T::one(), end_q, end_v);
        self.end.0 = t + T::from_f64(h);
    }
}
