//! The Gauss method with three stages, order 6, fixed steps: symplectic and symmetric, so that the energy of a conservative
//! system does not drift over long runs.
//!
//! Kuntzmann (1961), Butcher (1964); fixed-point iteration to rounding and compensated summation as in Hairer, Lubich &
//! Wanner, Geometric Numerical Integration (2006), section VIII.5 and VIII.6. For q̇ = v, v̇ = a the stages are
//!
//! ```text
//! Qᵢ = q + cᵢ h v + h² Σⱼ (A²)ᵢⱼ aⱼ,   Vᵢ = v + h Σⱼ Aᵢⱼ aⱼ,   aᵢ = a(t + cᵢ h, Qᵢ, Vᵢ)
//! ```

use super::control::fixed_length;
use super::{Acceleration, Accepted, Start, StepError, StepPolynomial, hermite};
use crate::arithmetic::{Scalar, epsilon};

const STAGES: usize = 3;
const ROOT15: f64 = 3.872_983_346_207_417;
const NODES: [f64; STAGES] = [0.5 - ROOT15 / 10.0, 0.5, 0.5 + ROOT15 / 10.0];
const A: [[f64; STAGES]; STAGES] = [
    [
        5.0 / 36.0,
        2.0 / 9.0 - ROOT15 / 15.0,
        5.0 / 36.0 - ROOT15 / 30.0,
    ],
    [
        5.0 / 36.0 + ROOT15 / 24.0,
        2.0 / 9.0,
        5.0 / 36.0 - ROOT15 / 24.0,
    ],
    [
        5.0 / 36.0 + ROOT15 / 30.0,
        2.0 / 9.0 + ROOT15 / 15.0,
        5.0 / 36.0,
    ],
];
const B: [f64; STAGES] = [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0];

/// Σⱼ rowⱼ Aⱼₖ
const fn times_a(row: [f64; STAGES]) -> [f64; STAGES] {
    let mut product = [0.0; STAGES];
    let mut k = 0;
    while k < STAGES {
        product[k] = row[0] * A[0][k] + row[1] * A[1][k] + row[2] * A[2][k];
        k += 1;
    }
    product
}

const SQUARE: [[f64; STAGES]; STAGES] = [times_a(A[0]), times_a(A[1]), times_a(A[2])];
const B_A: [f64; STAGES] = times_a(B);

/// A Gauss method with fixed steps, and its memory.
#[derive(Clone, Debug)]
pub struct Gauss<T> {
    step: f64,
    coordinates: usize,
    /// Accelerations at the stages, one row per stage.
    stages: Vec<T>,
    /// Accelerations at the start and at the end of the step.
    ends: [Vec<T>; 2],
    /// A stage's position, velocity and acceleration.
    trial: [Vec<T>; 3],
    /// Where the last step ended: time, positions, velocities.
    end: (T, [Vec<T>; 2]),
    /// Changes of positions and velocities over the step, then what rounding has taken from them.
    changes: [Vec<T>; 2],
    /// Size of the last step, if the next one goes on from it.
    last: Option<f64>,
}

impl<T: Scalar> Gauss<T> {
    /// Degree of the polynomials that [`Self::step`] writes.
    pub const DEGREE: usize = hermite::DEGREE;

    /// Steps of size `step` > 0 for `coordinates` coordinates.
    pub fn new(step: f64, coordinates: usize) -> Self {
        let zeros = || vec![T::zero(); coordinates];
        Self {
            step,
            coordinates,
            stages: vec![T::zero(); STAGES * coordinates],
            ends: [zeros(), zeros()],
            trial: [zeros(), zeros(), zeros()],
            end: (T::zero(), [zeros(), zeros()]),
            changes: [zeros(), zeros()],
            last: None,
        }
    }

    /// Forgets earlier steps: the system or its state is another one from here on.
    pub fn restart(&mut self) {
        self.last = None;
    }

    /// One step from a state, of the fixed size, or of `h_max` if that is smaller, with dense output into `out`.
    ///
    /// # Errors
    /// [`StepError::Acceleration`] where the system has no accelerations, [`StepError::NoConvergence`] if the step is too
    /// large for the iteration of its stages.
    pub fn step<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        h_max: f64,
        out: &mut StepPolynomial<T>,
    ) -> Result<Accepted, StepError<A::Error>> {
        let Start { t, q, v } = from;
        let size = fixed_length(self.step, h_max);
        let h = T::from_f64(size);
        let mut evaluations = self.begin(system, from, size)?;
        evaluations += self.iterate(system, from, size)?;

        // The changes still hold what rounding took from the step before: it is added now (Kahan 1965, Møller 1965).
        self.end.0 = t + h;
        for i in 0..self.coordinates {
            let (change_q, change_v) = (v[i] + h * self.weighted(B_A, i), self.weighted(B, i));
            self.changes[0][i] += h * change_q;
            self.changes[1][i] += h * change_v;
            self.end.1[0][i] = q[i] + self.changes[0][i];
            self.end.1[1][i] = v[i] + self.changes[1][i];
        }
        let [end_q, end_v] = &self.end.1;
        system
            .acceleration(self.end.0, end_q, end_v, &mut self.ends[1])
            .map_err(StepError::Acceleration)?;

        out.set_degree(Self::DEGREE);
        (out.t, out.h) = (t, h);
        for i in 0..self.coordinates {
            let start = [q[i], v[i], self.ends[0][i]];
            let changes = [v[i] + h * self.weighted(B_A, i), self.weighted(B, i)];
            let [change_q, change_v] = changes.map(|change| h * change);
            let end = [change_q, change_v, self.ends[1][i]];
            let (q, v) = out.rows_mut(i);
            hermite::quintic(h, start, end, q, v);
        }
        out.close_onto(end_q, end_v);
        let [end_q, end_v] = &mut self.end.1;
        out.state_into(T::one(), end_q, end_v);
        for i in 0..self.coordinates {
            self.changes[0][i] += q[i] - end_q[i];
            self.changes[1][i] += v[i] - end_v[i];
        }
        self.last = Some(size);
        Ok(Accepted {
            h: size,
            h_next: self.step,
            rejected: 0,
            evaluations: evaluations + 1,
        })
    }

    /// Σⱼ weightⱼ aⱼ of coordinate `i`.
    fn weighted(&self, weights: [f64; STAGES], i: usize) -> T {
        let column = self.stages[i..].iter().step_by(self.coordinates);
        column
            .zip(weights)
            .fold(T::zero(), |sum, (a, weight)| sum + T::from_f64(weight) * *a)
    }

    /// The acceleration at the start and first guesses at the stages; returns the number of evaluations.
    fn begin<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        h: f64,
    ) -> Result<usize, StepError<A::Error>> {
        let Start { t, q, v } = from;
        let n = self.coordinates;
        let [start, end] = &mut self.ends;
        let goes_on = self.end.0 == t && self.end.1[0] == q && self.end.1[1] == v;
        if let Some(last) = self.last.filter(|_| goes_on) {
            // The cubic through the last stages and the last end, seen from there.
            let known = [NODES[0] - 1.0, NODES[1] - 1.0, NODES[2] - 1.0, 0.0];
            for (i, end) in end.iter().enumerate() {
                let [first, second, third] = [0, n, 2 * n].map(|row| self.stages[row + i]);
                for (j, node) in NODES.into_iter().enumerate() {
                    let values = [first, second, third, *end];
                    self.stages[j * n + i] = extrapolate(known, values, node * h / last);
                }
            }
            core::mem::swap(start, end);
            return Ok(0);
        }
        self.last = None;
        self.changes
            .iter_mut()
            .for_each(|changes| changes.fill(T::zero()));
        system
            .acceleration(t, q, v, start)
            .map_err(StepError::Acceleration)?;
        for row in self.stages.chunks_exact_mut(n.max(1)) {
            row.copy_from_slice(start);
        }
        Ok(1)
    }

    /// Iterates the stages until rounding; returns the number of evaluations.
    fn iterate<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        size: f64,
    ) -> Result<usize, StepError<A::Error>> {
        let Start { t, q, v } = from;
        /// An iteration that needs more has a step that is far too large.
        const MAX_ITERATIONS: usize = 60;
        // Changes this small, relative to the accelerations, are allowed not to decrease any more: they are rounding. So are those
        // that velocities do not show, where forces balance.
        let rounding = (100.0 * epsilon::<T>()).max(1e-10);
        let n = self.coordinates;
        let h = T::from_f64(size);
        let mut previous = f64::INFINITY;
        let speed = v.iter().fold(1.0_f64, |m, v| m.max(v.value().abs()));
        let unseen = epsilon::<T>() * speed / size;
        for iteration in 1..=MAX_ITERATIONS {
            let (mut change, mut scale) = (0.0f64, 0.0f64);
            for j in 0..STAGES {
                let node = h * T::from_f64(NODES[j]);
                for i in 0..n {
                    self.trial[0][i] = q[i] + (node * v[i] + h * h * self.weighted(SQUARE[j], i));
                    self.trial[1][i] = v[i] + h * self.weighted(A[j], i);
                }
                let [q, v, a] = &mut self.trial;
                // The start of the step has accelerations: a stage without has been carried away by the iteration.
                if system.acceleration(t + node, q, v, a).is_err() {
                    change = f64::INFINITY;
                    break;
                }
                for (old, new) in self.stages[j * n..].iter_mut().zip(a) {
                    change = change.max((*new - *old).value().abs());
                    // A NaN must not pass for small.
                    scale = scale.max(new.value().abs());
                    if !new.value().is_finite() {
                        change = f64::INFINITY;
                    }
                    *old = *new;
                }
            }
            if change == f64::INFINITY {
                break;
            }
            let settled = change >= previous && change <= (rounding * scale).max(unseen);
            if change == 0.0 || settled {
                return Ok(STAGES * iteration);
            }
            previous = change;
        }
        let time = t.value();
        self.last = None;
        Err(StepError::NoConvergence { time, h: size })
    }
}

/// The cubic through (`nodes`, `values`) at `x` (Lagrange).
fn extrapolate<T: Scalar>(nodes: [f64; 4], values: [T; 4], x: f64) -> T {
    let mut sum = T::zero();
    for (j, value) in values.into_iter().enumerate() {
        let others = (0..4).filter(|i| *i != j);
        let weight: f64 = others
            .map(|i| (x - nodes[i]) / (nodes[j] - nodes[i]))
            .product();
        sum += T::from_f64(weight) * value;
    }
    sum
}
