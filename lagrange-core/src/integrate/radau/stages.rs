//! The stages: simplified Newton iteration with a Jacobian that is kept as long as it serves.

use super::{A, COLLOCATION, Iteration, MAX_ITERATIONS, NODES, REAL, Radau, SQUARE, STAGES};
use crate::arithmetic::Scalar;
use crate::integrate::{Acceleration, Tolerance};

impl<T: Scalar> Radau<T> {
    /// ∂a/∂q and ∂a/∂v at the start, from the system or by differences; returns the number of evaluations.
    pub(super) fn differentiate<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        t: T,
    ) -> Result<usize, A::Error> {
        let n = self.coordinates;
        let [q, v, a] = &self.start;
        let [by_position, by_velocity] = &mut self.jacobian;
        if system.jacobian(t, q, v, by_position, by_velocity)? {
            return Ok(0);
        }
        let [trial_q, trial_v, trial_a] = &mut self.trial;
        for (matrix, of_position) in [(by_position, true), (by_velocity, false)] {
            for j in 0..n {
                trial_q.copy_from_slice(q);
                trial_v.copy_from_slice(v);
                let moved = if of_position {
                    &mut trial_q[j]
                } else {
                    &mut trial_v[j]
                };
                let x = moved.value();
                // Rounding and curvature weigh the same at the root of ε.
                let delta = f64::EPSILON.sqrt() * x.abs().max(1e-3);
                *moved += T::from_f64(delta);
                let delta = moved.value() - x;
                system.acceleration(t, trial_q, trial_v, trial_a)?;
                for i in 0..n {
                    matrix[i * n + j] = (trial_a[i].value() - a[i].value()) / delta;
                }
            }
        }
        Ok(2 * n)
    }

    /// Newton's matrix and that of the error estimate for a step `h`; false if one is singular.
    pub(super) fn factor(&mut self, h: f64) -> bool {
        let n = self.coordinates;
        let [by_position, by_velocity] = &self.jacobian;
        let entries = self.newton.entries();
        let rows = STAGES * n;
        for i in 0..rows {
            for j in 0..rows {
                let (a, b) = ((i / n, i % n), (j / n, j % n));
                let k = a.1 * n + b.1;
                let coupled =
                    h * A[a.0][b.0] * by_velocity[k] + h * h * SQUARE[a.0][b.0] * by_position[k];
                entries[i * rows + j] = f64::from(i == j) - coupled;
            }
        }
        let entries = self.real.entries();
        let real = h * REAL;
        for k in 0..n * n {
            let unit = f64::from(k / n == k % n);
            entries[k] = unit - real * by_velocity[k] - real * real * by_position[k];
        }
        let regular = self.newton.factor() && self.real.factor();
        self.memory.factored = regular.then_some(h);
        regular
    }

    /// Starts the stages from the last collocation polynomial, or from rest.
    pub(super) fn guess(&mut self, h: f64) {
        let n = self.coordinates;
        let Some(last) = self.memory.last else {
            self.w.fill(T::zero());
            // How well extrapolated stages converge says nothing of an iteration from rest, whose first correction is far larger.
            self.memory.contraction = 1.0;
            return;
        };
        for i in 0..n {
            let values = [self.w[i], self.w[n + i], self.w[2 * n + i]];
            let at = |s: f64| {
                let weights = |k: usize| (0..STAGES).map(move |j| COLLOCATION[k][j]);
                (0..STAGES).rev().fold(T::zero(), |sum, k| {
                    let terms = weights(k).zip(values);
                    let c = terms.fold(T::zero(), |sum, (weight, value)| {
                        sum + T::from_f64(weight) * value
                    });
                    (sum + c) * T::from_f64(s)
                })
            };
            let end = values[STAGES - 1];
            let guesses = NODES.map(|node| at(1.0 + node * h / last) - end);
            for (j, guess) in guesses.into_iter().enumerate() {
                self.w[j * n + i] = guess;
            }
        }
    }

    /// Σⱼ rowⱼ xⱼ of coordinate `i`.
    pub(super) fn weighted(row: [f64; STAGES], x: &[T], n: usize, i: usize) -> T {
        let column = x[i..].iter().step_by(n);
        column
            .zip(row)
            .fold(T::zero(), |sum, (x, weight)| sum + T::from_f64(weight) * *x)
    }

    /// Simplified Newton iteration of the stages.
    pub(super) fn iterate<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        t: T,
        h: f64,
        tolerance: Tolerance,
        evaluations: &mut usize,
    ) -> Result<Iteration, A::Error> {
        let n = self.coordinates;
        let size = T::from_f64(h);
        // What remains of the iteration shall not be seen in the error.
        let relative = tolerance.strictness().clamp(1e-16, 1.0);
        let enough = (10.0 * f64::EPSILON / relative).max(relative.sqrt().min(0.03));
        let mut contraction = self.memory.contraction.max(f64::EPSILON).powf(0.8);
        let mut previous: Option<f64> = None;
        for iteration in 1..=MAX_ITERATIONS {
            for j in 0..STAGES {
                let node = size * T::from_f64(NODES[j]);
                for i in 0..n {
                    let z = node * self.start[1][i] + size * Self::weighted(A[j], &self.w, n, i);
                    self.z[j * n + i] = z;
                    self.trial[0][i] = self.start[0][i] + z;
                    self.trial[1][i] = self.start[1][i] + self.w[j * n + i];
                }
                let [q, v, a] = &mut self.trial;
                *evaluations += 1;
                system.acceleration(t + node, q, v, a)?;
                self.stages[j * n..][..n].copy_from_slice(a);
            }
            for (j, row) in A.into_iter().enumerate() {
                for i in 0..n {
                    let target = size * Self::weighted(row, &self.stages, n, i);
                    self.residual[j * n + i] = target - self.w[j * n + i];
                }
            }
            self.newton.solve(&mut self.residual);
            let change = self.size_of_correction(h, tolerance);
            if !change.is_finite() {
                return Ok(Iteration::Failed);
            }
            for (w, correction) in self.w.iter_mut().zip(&self.residual) {
                *w += *correction;
            }
            let mut rate = 0.0;
            if let Some(previous) = previous {
                rate = change / previous;
                if rate >= 1.0 {
                    return Ok(Iteration::Failed);
                }
                contraction = rate / (1.0 - rate);
                let left = (MAX_ITERATIONS - iteration) as f64;
                if contraction * change * rate.powf(left) > enough {
                    return Ok(Iteration::Failed);
                }
            }
            previous = Some(change.max(f64::MIN_POSITIVE));
            if contraction * change <= enough {
                self.memory.contraction = contraction;
                self.settle(h);
                return Ok(Iteration::Converged {
                    iterations: iteration,
                    rate,
                });
            }
        }
        Ok(Iteration::Failed)
    }

    /// Largest stage of the correction in units of the tolerance, positions and velocities alike.
    fn size_of_correction(&self, h: f64, tolerance: Tolerance) -> f64 {
        let n = self.coordinates;
        let mut largest = 0.0f64;
        for (j, row) in A.into_iter().enumerate() {
            let mut sum = 0.0;
            for i in 0..n {
                let velocity = self.residual[j * n + i].value();
                let position = h * Self::weighted(row, &self.residual, n, i).value();
                let [q, v] = [0, 1].map(|k| tolerance.scale(i, self.start[k][i].value().abs()));
                sum += (position / q).powi(2) + (velocity / v).powi(2);
            }
            let size = (sum / (2 * n).max(1) as f64).sqrt();
            // A NaN must win.
            if size > largest || size.is_nan() {
                largest = size;
            }
            if largest.is_nan() {
                break;
            }
        }
        largest
    }

    /// Positions that belong to the final velocities, and the state at the end.
    pub(super) fn settle(&mut self, h: f64) {
        let n = self.coordinates;
        let size = T::from_f64(h);
        for (j, row) in A.into_iter().enumerate() {
            let node = size * T::from_f64(NODES[j]);
            for i in 0..n {
                self.z[j * n + i] =
                    node * self.start[1][i] + size * Self::weighted(row, &self.w, n, i);
            }
        }
        for i in 0..n {
            self.end.1[0][i] = self.start[0][i] + self.z[2 * n + i];
            self.end.1[1][i] = self.start[1][i] + self.w[2 * n + i];
        }
    }
}
