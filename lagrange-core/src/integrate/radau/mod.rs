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

mod estimate;
mod stages;

use super::control::{Tolerance, error_norm, least_first_step};
use super::factors::Factors;
use super::{Acceleration, Accepted, Start, StepError, StepPolynomial};
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
    /// η of the last iteration, with which the next one begins if its stages are extrapolated.
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
    /// The system has no accelerations at the start.
    pub fn first_step<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        h_max: f64,
        tolerance: Tolerance,
    ) -> Result<f64, StepError<A::Error>> {
        let Start { t, q, v } = from;
        let a = &mut self.trial[2];
        system
            .acceleration(t, q, v, a)
            .map_err(StepError::Acceleration)?;
        let norm = |x: &[T], scale: &[T]| error_norm(x, scale, scale, tolerance);
        let size = norm(q, q).max(norm(v, v));
        let rate = norm(v, q).max(norm(a, v));
        let h = if size < 1e-5 || rate < 1e-5 {
            least_first_step(t.value())
        } else {
            0.01 * size / rate
        };
        Ok(h.min(h_max))
    }

    /// One step from a state, of at most `h_try` > 0, repeated with smaller ones until its error is within
    /// `tolerance`, with dense output into `out`.
    ///
    /// # Errors
    /// [`StepError::Acceleration`] if the system has no accelerations at the start, or none however small the step;
    /// [`StepError::TooSmall`] if the step size has shrunk to rounding errors of the time.
    pub fn step<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        h_try: f64,
        tolerance: Tolerance,
        out: &mut StepPolynomial<T>,
    ) -> Result<Accepted, StepError<A::Error>> {
        let Start { t, q, v } = from;
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
}
