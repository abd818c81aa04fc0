//! Embedded explicit Runge–Kutta methods: one driver for every [`Tableau`].
//!
//! The state is y = (q, v), f = (v, a(t, q, v)). Rows of stages are padded to a multiple of [`LANES`] numbers, so that a
//! weighted sum of stages keeps its results in registers.

mod dense;

use super::control::{Controller, Tolerance, error_norm, fixed_length, least_first_step};
use super::tableau::{Estimate, Tableau, Weights};
use super::{Acceleration, Accepted, Method, Start, StepError, StepPolynomial, hermite};
use super::{dop853, dopri5, rk4, verner98};
use crate::arithmetic::Scalar;

/// Numbers that one pass over the stages sums side by side.
const LANES: usize = 4;

/// An explicit Runge–Kutta method and its memory.
#[derive(Clone, Debug)]
pub struct RungeKutta<T> {
    tableau: &'static Tableau,
    controller: Controller,
    fixed_step: Option<f64>,
    coordinates: usize,
    width: usize,
    /// kᵢ, one row per stage.
    k: Vec<T>,
    /// Bernstein coefficients of the dense output, then differences of them; row m − 1 is Bₘ.
    dense: Vec<T>,
    start: State<T>,
    end: State<T>,
    stage: Vec<T>,
    error: Vec<T>,
    /// Whether the stage at `end` has been evaluated.
    end_known: bool,
}

/// A time and y = (q, v, padding).
#[derive(Clone, Debug)]
struct State<T> {
    t: T,
    y: Vec<T>,
}

impl<T: Scalar> RungeKutta<T> {
    /// `method` for `coordinates` coordinates. `None` if it is not an explicit Runge–Kutta method.
    pub fn new(method: Method, coordinates: usize) -> Option<Self> {
        let (tableau, fixed_step) = match method {
            Method::DormandPrince853 => (&dop853::TABLEAU, None),
            Method::DormandPrince54 => (&dopri5::TABLEAU, None),
            Method::Verner98 => (&verner98::TABLEAU, None),
            Method::RungeKutta4 { step } => (&rk4::TABLEAU, Some(step)),
            _ => return None,
        };
        let width = (2 * coordinates).next_multiple_of(LANES);
        let zeros = |rows: usize| vec![T::zero(); rows * width];
        let state = State {
            t: T::zero(),
            y: zeros(1),
        };
        Some(Self {
            tableau,
            controller: Controller::new(tableau.control),
            fixed_step,
            coordinates,
            width,
            k: zeros(tableau.nodes.len()),
            dense: zeros(tableau.dense.len() + 1),
            start: state.clone(),
            end: state,
            stage: zeros(1),
            error: zeros(1),
            end_known: false,
        })
    }

    /// Degree of the polynomials that [`Self::step`] writes.
    pub fn degree(&self) -> usize {
        if self.tableau.dense.is_empty() {
            hermite::DEGREE
        } else {
            self.tableau.dense.len() + 1
        }
    }

    /// Whether it chooses its steps by their errors.
    pub fn is_adaptive(&self) -> bool {
        self.fixed_step.is_none()
    }

    /// Forgets earlier steps: the system or its state is another one from here on.
    pub fn restart(&mut self) {
        self.controller.restart();
        self.end_known = false;
    }

    /// A first step size, at most `h_max`, from the sizes of the solution and its first two derivatives (Hairer, Nørsett &
    /// Wanner 1993, section II.4). Two evaluations, one of which the first step uses again.
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
        if let Some(step) = self.fixed_step {
            return Ok(step.min(h_max));
        }
        self.begin(system, from)?;
        // What the first step starts with.
        self.end.t = from.t;
        self.end.y.copy_from_slice(&self.start.y);
        let size = 2 * self.coordinates;
        let norm = |x: &[T], y: &[T]| error_norm(&x[..size], &y[..size], &y[..size], tolerance);
        let y = &self.start.y;
        let slope = &self.k[..self.width];
        let (d0, d1) = (norm(y, y), norm(slope, y));
        let euler = if d0 < 1e-5 || d1 < 1e-5 {
            least_first_step(from.t.value())
        } else {
            0.01 * d0 / d1
        };
        let euler = euler.min(h_max);
        let step = T::from_f64(euler);
        for (z, (y, k)) in self.stage.iter_mut().zip(y.iter().zip(slope)) {
            *z = *y + step * *k;
        }
        // In a state that exists nowhere, the first step will tell.
        let end = self.tableau.end;
        let h = if self.evaluate(system, from.t + step, end).is_ok() {
            let (slope, probe) = (
                &self.k[..self.width],
                &self.k[end * self.width..][..self.width],
            );
            for (e, (a, b)) in self.error.iter_mut().zip(slope.iter().zip(probe)) {
                *e = *b - *a;
            }
            let d2 = error_norm(
                &self.error[..size],
                &self.start.y[..size],
                &self.start.y[..size],
                tolerance,
            ) / euler;
            let curve = if d1.max(d2) <= 1e-15 {
                (euler * 1e-3).max(least_first_step(from.t.value()))
            } else {
                (0.01 / d1.max(d2)).powf(1.0 / self.tableau.order as f64)
            };
            curve.min(100.0 * euler)
        } else {
            euler
        };
        // The probe has overwritten the stage at the end; keep what the first step needs there.
        self.k.copy_within(..self.width, end * self.width);
        self.end_known = true;
        Ok(h.min(h_max))
    }

    /// One step from a state, of at most `h_try` > 0, with dense output: [`Self::advance`], then [`Self::interpolate`].
    ///
    /// The step's result is what `out` has at s = 1.
    ///
    /// # Errors
    /// See [`Self::advance`].
    pub fn step<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        h_try: f64,
        tolerance: Tolerance,
        out: &mut StepPolynomial<T>,
    ) -> Result<Accepted, StepError<A::Error>> {
        let mut accepted = self.advance(system, from, h_try, tolerance)?;
        accepted.evaluations += self.interpolate(system, out)?;
        Ok(accepted)
    }

    /// One step from a state, of at most `h_try` > 0, repeated with smaller ones until its error is within `tolerance`.
    /// The result is [`Self::end`].
    ///
    /// The first stage is the last one of the step before if the state is the one where that ended.
    ///
    /// # Errors
    /// [`StepError::Acceleration`] if the system has no accelerations at the start, or none however small the step;
    /// [`StepError::TooSmall`] if the step size has shrunk to rounding errors of the time.
    pub fn advance<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
        h_try: f64,
        tolerance: Tolerance,
    ) -> Result<Accepted, StepError<A::Error>> {
        let t = from.t;
        let mut evaluations = self.begin(system, from)?;
        let mut rejected = 0;
        let mut h = (self.fixed_step).map_or(h_try, |step| fixed_length(step, h_try));
        let mut obstacle = None;
        loop {
            // What time rounds off would be a jump of fast motions.
            h = (t + T::from_f64(h)).value() - t.value();
            let smallest = 16.0 * f64::EPSILON * t.value().abs().max(f64::MIN_POSITIVE);
            if h.is_nan() || h <= smallest {
                let too_small = StepError::TooSmall { time: t.value(), h };
                return Err(obstacle.map_or(too_small, StepError::Acceleration));
            }
            let verdict = match self.attempt(system, h, tolerance, &mut evaluations) {
                Ok(error) if self.fixed_step.is_some() => {
                    if error.is_nan() {
                        return Err(StepError::TooSmall { time: t.value(), h });
                    }
                    Ok(self.fixed_step.unwrap_or(h))
                }
                Ok(error) => self.controller.judge(h, error),
                Err(error) if self.fixed_step.is_some() => {
                    return Err(StepError::Acceleration(error));
                }
                Err(error) => {
                    obstacle = Some(error);
                    self.controller.judge(h, f64::NAN)
                }
            };
            match verdict {
                Ok(h_next) => {
                    return Ok(Accepted {
                        h,
                        h_next,
                        rejected,
                        evaluations,
                    });
                }
                Err(smaller) => {
                    rejected += 1;
                    h = smaller;
                }
            }
        }
    }

    /// Positions and velocities at the end of the last step.
    pub fn end(&self) -> (&[T], &[T]) {
        let n = self.coordinates;
        (&self.end.y[..n], &self.end.y[n..2 * n])
    }

    /// Loads the state and has its derivative as stage 0; returns the number of evaluations.
    fn begin<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        from: Start<'_, T>,
    ) -> Result<usize, StepError<A::Error>> {
        let Start { t, q, v } = from;
        let n = self.coordinates;
        let y = &mut self.start.y;
        y[..n].copy_from_slice(q);
        y[n..2 * n].copy_from_slice(v);
        self.start.t = t;
        if self.end_known && self.end.t == t && self.end.y == *y {
            self.k.copy_within(
                self.tableau.end * self.width..(self.tableau.end + 1) * self.width,
                0,
            );
            return Ok(0);
        }
        self.stage.copy_from_slice(y);
        self.end_known = false;
        self.evaluate(system, t, 0)
            .map_err(StepError::Acceleration)?;
        Ok(1)
    }

    /// kᵢ from the state in `stage`.
    fn evaluate<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        t: T,
        i: usize,
    ) -> Result<(), A::Error> {
        let n = self.coordinates;
        let (q, v) = self.stage[..2 * n].split_at(n);
        let (dq, dv) = self.k[i * self.width..][..2 * n].split_at_mut(n);
        dq.copy_from_slice(v);
        system.acceleration(t, q, v, dv)
    }

    /// A step of size `h` into `end`; returns its error in units of the tolerance, NaN if a number is not finite.
    fn attempt<A: Acceleration<T>>(
        &mut self,
        system: &mut A,
        h: f64,
        tolerance: Tolerance,
        evaluations: &mut usize,
    ) -> Result<f64, A::Error> {
        let Tableau {
            nodes,
            stages,
            end,
            ref estimate,
            ..
        } = *self.tableau;
        let t = self.start.t;
        let step = T::from_f64(h);
        self.end_known = false;
        for i in 1..end {
            combine(
                &mut self.stage,
                Some(&self.start.y),
                step,
                stages[i],
                &self.k,
            );
            *evaluations += 1;
            self.evaluate(system, t + step * T::from_f64(nodes[i]), i)?;
        }
        combine(
            &mut self.stage,
            Some(&self.start.y),
            step,
            stages[end],
            &self.k,
        );
        self.end.t = t + step;
        self.end.y.copy_from_slice(&self.stage);
        let error = if estimate.reads(end) {
            *evaluations += 1;
            self.evaluate(system, t + step, end)?;
            self.estimate(step, tolerance)
        } else {
            let error = self.estimate(step, tolerance);
            // What will be rejected is not evaluated.
            if error <= 1.0 {
                *evaluations += 1;
                self.evaluate(system, t + step, end)?;
            }
            error
        };
        let derivative = &self.k[end * self.width..][..self.width];
        let finite = self
            .end
            .y
            .iter()
            .chain(derivative)
            .all(|y| y.value().is_finite());
        self.end_known = finite;
        Ok(if finite { error } else { f64::NAN })
    }

    fn estimate(&mut self, h: T, tolerance: Tolerance) -> f64 {
        let size = 2 * self.coordinates;
        let mut norm = |weights: Weights| {
            combine(&mut self.error, None, h, weights, &self.k);
            error_norm(&self.error[..size], &self.start.y, &self.end.y, tolerance)
        };
        match self.tableau.estimate {
            Estimate::None => 0.0,
            Estimate::Embedded(weights) => norm(weights),
            Estimate::Combined { fifth, third } => {
                let (fifth, third) = (norm(fifth), norm(third));
                if fifth == 0.0 {
                    fifth
                } else {
                    fifth * fifth / (fifth * fifth + 0.01 * third * third).sqrt()
                }
            }
        }
    }
}

/// `out` = `base` + h Σ weight · stage, [`LANES`] numbers at a time.
fn combine<T: Scalar>(out: &mut [T], base: Option<&[T]>, h: T, weights: Weights, k: &[T]) {
    let width = out.len();
    for x in (0..width).step_by(LANES) {
        let mut sum = [T::zero(); LANES];
        for &(stage, weight) in weights {
            let weight = T::from_f64(weight);
            let lanes = &k[stage * width + x..][..LANES];
            for (sum, k) in sum.iter_mut().zip(lanes) {
                *sum += weight * *k;
            }
        }
        let out = &mut out[x..][..LANES];
        match base {
            Some(base) => {
                for (out, (base, sum)) in out.iter_mut().zip(base[x..][..LANES].iter().zip(sum)) {
                    *out = *base + h * sum;
                }
            }
            None => {
                for (out, sum) in out.iter_mut().zip(sum) {
                    *out = h * sum;
                }
            }
        }
    }
}
