//! Dense output: extra stages, then from Bernstein coefficients to those of powers.

use super::{RungeKutta, combine};
use crate::arithmetic::Scalar;
use crate::integrate::{Acceleration, StepError, StepPolynomial, hermite};

impl<T: Scalar> RungeKutta<T> {
    /// Dense output of the last step, after [`Self::advance`]; returns how many evaluations it took.
    ///
    /// # Errors
    /// [`StepError::Acceleration`] if the system has no accelerations at a stage of the dense output.
    pub fn interpolate<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        out: &mut StepPolynomial<T>,
    ) -> Result<usize, StepError<A::Error>> {
        let h = self.end.t - self.start.t;
        let degree = self.degree();
        let extra = self.tableau.end + 1..self.tableau.nodes.len();
        for i in extra.clone() {
            let t = self.start.t + h * T::from_f64(self.tableau.nodes[i]);
            combine(
                &mut self.stage,
                Some(&self.start.y),
                h,
                self.tableau.stages[i],
                &self.k,
            );
            self.evaluate(system, t, i)
                .map_err(StepError::Acceleration)?;
        }
        out.set_degree(degree);
        out.t = self.start.t;
        out.h = h;
        if self.tableau.dense.is_empty() {
            self.write_hermite(out);
        } else {
            self.write_dense(out);
        }
        let n = self.coordinates;
        out.close_onto(&self.end.y[..n], &self.end.y[n..2 * n]);
        let (q, v) = self.end.y.split_at_mut(n);
        out.state_into(T::one(), q, &mut v[..n]);
        Ok(extra.len())
    }

    /// Bernstein coefficients relative to y₀, their differences, and from these the coefficients of the powers.
    fn write_dense(&mut self, out: &mut StepPolynomial<T>) {
        let (n, width) = (self.coordinates, self.width);
        let degree = self.tableau.dense.len() + 1;
        for (row, weights) in self.dense.chunks_exact_mut(width).zip(self.tableau.dense) {
            combine(row, None, out.h, weights, &self.k);
        }
        let last = &mut self.dense[(degree - 1) * width..];
        for (b, (y1, y0)) in last.iter_mut().zip(self.end.y.iter().zip(&self.start.y)) {
            *b = *y1 - *y0;
        }
        // Row 1 stays as it is, since B₀ = 0.
        for r in 1..=degree {
            for m in (r.max(2)..=degree).rev() {
                let (before, row) = self.dense[(m - 2) * width..].split_at_mut(width);
                for (b, a) in row[..width].iter_mut().zip(before) {
                    *b -= *a;
                }
            }
        }
        for i in 0..n {
            let (q, v) = out.rows_mut(i);
            q[0] = self.start.y[i];
            v[0] = self.start.y[n + i];
            let mut binomial = 1.0;
            for k in 1..=degree {
                binomial = binomial * (degree + 1 - k) as f64 / k as f64;
                let row = &self.dense[(k - 1) * width..];
                q[k] = T::from_f64(binomial) * row[i];
                v[k] = T::from_f64(binomial) * row[n + i];
            }
        }
    }

    fn write_hermite(&mut self, out: &mut StepPolynomial<T>) {
        let n = self.coordinates;
        let end = self.tableau.end;
        let changes = &mut self.stage;
        combine(changes, None, out.h, self.tableau.stages[end], &self.k);
        for i in 0..n {
            let start = [self.start.y[i], self.start.y[n + i], self.k[n + i]];
            let a = self.k[end * self.width + n + i];
            let end = [changes[i], changes[n + i], a];
            let h = out.h;
            let (q, v) = out.rows_mut(i);
            hermite::quintic(h, start, end, q, v);
        }
    }
}
