//! Radau IIA of order 5, for stiff systems: three implicit stages at (4 ∓ √6)/10 and 1, L-stable, stiffly accurate.
//!
//! Hairer & Wanner, Solving Ordinary Differential Equations II (1996), sections IV.5 and IV.8, whose code RADAU5 gives the
//! error estimate, the rules of the simplified Newton iteration and Gustafsson's predictive control. For q̇ = v, v̇ = a the
//! unknowns are the changes of the velocities alone, w = V − v; the positions follow,
//!
//! ```text
//! wᵢ = h Σⱼ Aᵢⱼ a(tⱼ, Qⱼ, v + wⱼ),   Qᵢ = q + h cᵢ v + h Σⱼ Aᵢⱼ wⱼ,
//! Newton's matrix  I − h A ⊗ ∂a/∂v − h² A² ⊗ ∂a/∂q.
//! ```
//!
//! Dense output is the collocation polynomial, of degree 3: its order is 3 as everywhere with this method.

use super::control::{Tolerance, error_norm};
use super::factors::Factors;
use super::{Acceleration, Accepted, StepError, StepPolynomial};
use crate::arithmetic::Scalar;

const STAGES: usize = 3;
const NODES: [f64; STAGES] = [0.1550510257216822, 0.6449489742783178, 1.0];
const A: [[f64; STAGES]; STAGES] = [
    [
        0.1968154772236604,
        -0.06553542585019839,
        0.02377097434822015,
    ],
    [0.3944243147390873, 0.2920734116652285, -0.04154875212599793],
    [0.37640306270046725, 0.5124858261884216, 0.1111111111111111],
];
/// A²
const SQUARE: [[f64; STAGES]; STAGES] = [
    [
        0.02183503419072274,
        -0.019857254098612276,
        0.01004263019656241,
    ],
    [
        0.1771905874319456,
        0.03816496580927726,
        -0.007375963529895745,
    ],
    [0.31804138174397717, 0.18195861825602283, 0.0],
];
/// The real eigenvalue of A: the error estimate's implicit stage.
const REAL: f64 = 0.27488882959567734;
/// γ₀/3 (−13 − 7√6, −13 + 7√6, −1)
const ESTIMATE: [f64; STAGES] = [-2.7623054547485992, 0.3799355982527289, -0.0916296098652258];
/// Coefficient of s^(k+1) of the polynomial with value 0 at 0 and 1 at node i, 0 at the others: row k, column i.
const COLLOCATION: [[f64; STAGES]; STAGES] = [
    [10.048809399827416, -1.382142733160749, 0.3333333333333333],
    [-25.62959144707664, 10.296258113743306, -2.6666666666666665],
    [15.580782047249224, -8.914115380582556, 3.3333333333333335],
];
/// Newton iterations before the step is halved.
const MAX_ITERATIONS: usize = 7;

/// Radau IIA of order 5 and its memory.
#[derive(Clone, Debug)]
pub struct Radau<T> {
    coordinates: usize,
    /// wᵢ and what it changes the positions by, one row per stage.
    w: Vec<T>,
    z: Vec<T>,
    /// Residual of the stages, then Newton's correction.
    residual: Vec<T>,
    /// Accelerations at the stages.
    stages: Vec<T>,
    /// State and acceleration at the start, and a trial state with its acceleration.
    start: [Vec<T>; 3],
    trial: [Vec<T>; 3],
    error: [Vec<T>; 2],
    end: (T, [Vec<T>; 2]),
    /// ∂a/∂q and ∂a/∂v, row-major, where the last Jacobian was taken.
    jacobian: [Vec<f64>; 2],
    newton: Factors,
    real: Factors,
    memory: Memory,
}

/// What is kept from step to step.
#[derive(Clone, Debug)]
struct Memory {
    /// Size of the step whose collocation polynomial is still in `w`, `z`.
    last: Option<f64>,
    /// Whether `jacobian` may be used again, and the step size with which it is factored.
    jacobian: bool,
    factored: Option<f64>,
    /// η of the last iteration.
    contraction: f64,
    /// Size and error of the last accepted step.
    accepted: Option<(f64, f64)>,
}

impl Default for Memory {
    fn default() -> Self {
        Self {
            last: None,
            jacobian: false,
            factored: None,
            contraction: 1.0,
            accepted: None,
        }
    }
}

/// How a Newton iteration ended.
enum Iteration {
    Converged { iterations: usize, rate: f64 },
    Failed,
}

impl<T: Scalar> Radau<T> {
    /// Degree of the polynomials that [`Self::step`] writes.
    pub const DEGREE: usize = STAGES;
    /// Order of the step's result.
    pub const ORDER: usize = 5;

    /// For `coordinates` coordinates.
    pub fn new(coordinates: usize) -> Self {
        let n = coordinates;
        let zeros = |rows: usize| vec![T::zero(); rows * n];
        Self {
            coordinates,
            w: zeros(STAGES),
            z: zeros(STAGES),
            residual: zeros(STAGES),
            stages: zeros(STAGES),
            start: [zeros(1), zeros(1), zeros(1)],
            trial: [zeros(1), zeros(1), zeros(1)],
            error: [zeros(1), zeros(1)],
            end: (T::zero(), [zeros(1), zeros(1)]),
            jacobian: [vec![0.0; n * n], vec![0.0; n * n]],
            newton: Factors::new(STAGES * n),
            real: Factors::new(n),
            memory: Memory::default(),
        }
    }

    /// Forgets earlier steps: the system or its state is another one from here on.
    pub fn restart(&mut self) {
        self.memory = Memory::default();
    }

    /// A first step size, at most `h_max`: a hundredth of the time in which the solution changes by its own size. One
    /// evaluation.
    ///
    /// # Errors
    /// Of the system at the start.
    pub fn first_step<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        t: T,
        q: &[T],
        v: &[T],
        h_max: f64,
        tolerance: Tolerance,
    ) -> Result<f64, StepError<A::Error>> {
        let a = &mut self.trial[2];
        system
            .acceleration(t, q, v, a)
            .map_err(StepError::Acceleration)?;
        let norm = |x: &[T], scale: &[T]| error_norm(x, scale, scale, tolerance);
        let size = norm(q, q).max(norm(v, v));
        let rate = norm(v, q).max(norm(a, v));
        let h = if size < 1e-5 || rate < 1e-5 {
            1e-6
        } else {
            0.01 * size / rate
        };
        Ok(h.min(h_max))
    }

    /// One step from (`t`, `q`, `v`) of at most `h_try` > 0, repeated with smaller ones until its error is within
    /// `tolerance`, with dense output into `out`.
    ///
    /// # Errors
    /// [`StepError::Acceleration`] if the system has no accelerations at the start, or none however small the step;
    /// [`StepError::TooSmall`] if the step size has shrunk to rounding errors of the time.
    #[expect(clippy::too_many_arguments, reason = "a state and a request")]
    pub fn step<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        t: T,
        q: &[T],
        v: &[T],
        h_try: f64,
        tolerance: Tolerance,
        out: &mut StepPolynomial<T>,
    ) -> Result<Accepted, StepError<A::Error>> {
        if !(self.end.0 == t && self.end.1[0] == q && self.end.1[1] == v) {
            // The stages no longer extrapolate; the Jacobian is as good as before.
            self.memory.last = None;
        }
        let [start_q, start_v, start_a] = &mut self.start;
        start_q.copy_from_slice(q);
        start_v.copy_from_slice(v);
        system
            .acceleration(t, q, v, start_a)
            .map_err(StepError::Acceleration)?;
        let mut evaluations = 1;
        let mut fresh = false;
        let mut rejected = 0;
        let mut h = h_try;
        let mut obstacle = None;
        loop {
            let smallest = 16.0 * f64::EPSILON * t.value().abs().max(f64::MIN_POSITIVE);
            if h.is_nan() || h <= smallest {
                let too_small = StepError::TooSmall { time: t.value(), h };
                return Err(obstacle.map_or(too_small, StepError::Acceleration));
            }
            if !self.memory.jacobian {
                evaluations += self
                    .differentiate(system, t)
                    .map_err(StepError::Acceleration)?;
                (self.memory.jacobian, self.memory.factored, fresh) = (true, None, true);
            }
            if self.memory.factored != Some(h) && !self.factor(h) {
                (rejected, h) = (rejected + 1, 0.5 * h);
                continue;
            }
            self.guess(h);
            let outcome = match self.iterate(system, t, h, tolerance, &mut evaluations) {
                Ok(Iteration::Converged { iterations, rate }) => {
                    match self.estimate(system, t, h, tolerance, rejected > 0, &mut evaluations) {
                        Ok(error) if error.is_finite() => Ok((iterations, rate, error)),
                        Ok(_) => Err(None),
                        Err(error) => Err(Some(error)),
                    }
                }
                Ok(Iteration::Failed) => Err(None),
                Err(error) => Err(Some(error)),
            };
            let (iterations, rate, error) = match outcome {
                Ok(outcome) => outcome,
                Err(error) => {
                    obstacle = error.or(obstacle);
                    rejected += 1;
                    h *= 0.5;
                    self.memory.last = None;
                    self.memory.jacobian = fresh;
                    continue;
                }
            };
            let next = self.next_step(h, error, iterations);
            if error > 1.0 {
                (rejected, h) = (rejected + 1, next.min(0.9 * h));
                self.memory.last = None;
                continue;
            }
            self.memory.accepted = Some((h, error.max(1e-2)));
            self.memory.last = Some(h);
            self.memory.jacobian = rate < 1e-3;
            self.write(t, h, out);
            let h_next = if rejected > 0 { next.min(h) } else { next };
            // Factors are worth more than a slightly larger step.
            let keep = self.memory.jacobian && (1.0..=1.2).contains(&(h_next / h));
            return Ok(Accepted {
                h,
                h_next: if keep { h } else { h_next },
                rejected,
                evaluations,
            });
        }
    }

    /// Step size from the error, predicted from the last two (Gustafsson 1994).
    fn next_step(&self, h: f64, error: f64, iterations: usize) -> f64 {
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

    /// ∂a/∂q and ∂a/∂v at the start, from the system or by differences; returns the number of evaluations.
    fn differentiate<A: Acceleration<T>>(
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
    fn factor(&mut self, h: f64) -> bool {
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
    fn guess(&mut self, h: f64) {
        let n = self.coordinates;
        let Some(last) = self.memory.last else {
            self.w.fill(T::zero());
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
    fn weighted(row: [f64; STAGES], x: &[T], n: usize, i: usize) -> T {
        let column = x[i..].iter().step_by(n);
        column
            .zip(row)
            .fold(T::zero(), |sum, (x, weight)| sum + T::from_f64(weight) * *x)
    }

    /// Simplified Newton iteration of the stages.
    fn iterate<A: Acceleration<T>>(
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
                let [q, v] = [0, 1].map(|k| tolerance.scale(self.start[k][i].value().abs()));
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
    fn settle(&mut self, h: f64) {
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

    /// Error of the step in units of the tolerance.
    fn estimate<A: Acceleration<T>>(
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
    fn write(&mut self, t: T, h: f64, out: &mut StepPolynomial<T>) {
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
