//! What the polynomials of a step say against the accelerations that are reported: the error of the step.
//!
//! Dense output of Runge–Kutta methods is of lower order than their steps, so its derivative says little. What a step promises is
//! its end: v(end) − v(0) − ∫ a dt and q(end) − q(0) − ∫ v dt, with the reported accelerations a along the dense output, are the
//! error of the step and h·∂a/∂q times that of the dense output. The integrals are by Gauss–Legendre quadrature. In stiff systems h·∂a/∂v is
//! large: of the steps of Radau what counts is the part of the error that is not damped at once; and so in those in which slips of two components turn, where it is followed along the step.
//!
//! Where the dense output is as good as the step, as a Taylor series is, its defects q̇ − v and v̇ − a are as small as its error. Then their
//! absolute values at three places, by Radau's quadrature, are more than the integral of a defect that grows towards the end, and
//! where that is below the tolerance nothing else is evaluated.

use super::motion::Examination;
use super::quadrature::{RADAU, gauss};
use crate::arithmetic::{Scalar, epsilon};
use crate::error::Error;
use crate::integrate::{Acceleration, Radau, least_size};
use crate::trajectory::{Segment, State};
use nalgebra::{DMatrix, DVector};

/// Positions are known to so many units of rounding.
const ULPS: f64 = 16.0;

impl<T: Scalar> Examination<'_, T> {
    /// Finds the errors of a step, and what they are measured by, from the defects of its dense output. Whether they are below the tolerance.
    pub(super) fn has_small_defects(&mut self, segment: &Segment<T>) -> Result<bool, Error> {
        let span = (segment.h * segment.end).value();
        self.start_errors(0.0);
        for (part, weight) in RADAU {
            let s = segment.end * T::from_f64(part);
            self.accelerate(segment, s, false)?;
            for i in 0..self.begin.q.len() {
                let (dq, dv) = (self.rates.q[i] / segment.h, self.rates.v[i] / segment.h);
                let defects = [dq - self.scratch.v[i], dv - self.acceleration[i]];
                let [q, v] = defects.map(|defect| defect.value().abs());
                self.errors.q[i] += weight * span * q;
                self.errors.v[i] += weight * span * v;
            }
        }
        Ok(self.errors_are_small())
    }

    /// Whether the errors found are below the tolerance.
    pub(super) fn errors_are_small(&self) -> bool {
        let small = |errors: &[f64], sizes: &[f64]| {
            let mut pairs = errors.iter().zip(sizes).enumerate();
            pairs.all(|(i, (error, size))| {
                let least = least_size(&self.record.asked.sizes, i);
                error.abs() <= self.findings.tolerance * (least + size)
            })
        };
        small(&self.errors.q, &self.sizes.q) && small(&self.errors.v, &self.sizes.v)
    }

    /// Finds the errors of a step, and what they are measured by, from the integrals of velocities and accelerations.
    pub(super) fn integrate(&mut self, segment: &Segment<T>) -> Result<(), Error> {
        // A step over a position where constraints lose rank has it in its middle: no point is there.
        let points = (segment.degree / 2 + 2).next_multiple_of(2);
        if self.nodes.len() != points {
            self.nodes = gauss(points);
        }
        let (h, end) = (segment.h.value(), segment.end.value());
        self.start_errors(1.0);
        for i in 0..points {
            let (x, w) = self.nodes[i];
            self.accelerate(segment, T::from_f64(0.5 * end * (1.0 + x)), true)?;
            let weight = 0.5 * end * h * w;
            let rates = [
                (&mut self.errors.q, &self.scratch.v),
                (&mut self.errors.v, &self.acceleration),
            ];
            for (sums, rates) in rates {
                let pairs = sums.iter_mut().zip(rates);
                pairs.for_each(|(sum, rate)| *sum += weight * rate.value());
            }
        }
        if segment.degree == Radau::<T>::DEGREE {
            self.damp(segment, end, h * end)?;
        }
        Ok(())
    }

    /// The same where slips of two components turn: the direction of one that has hardly begun follows the forces at once, and turns with them in a step.
    /// An error e follows ė = J e + δ, δ the defect of the dense output, here by steps of the linearly implicit method of Euler.
    pub(super) fn follow(&mut self, segment: &Segment<T>) -> Result<(), Error> {
        let (h, end) = (segment.h.value(), segment.end.value());
        let nodes = gauss(segment.degree / 2 + 2);
        self.start_errors(0.0);
        for (x, w) in nodes {
            let (s, weight) = (0.5 * end * (1.0 + x), 0.5 * end * h * w);
            self.dynamics.set_mode(&self.record.modes[segment.mode]);
            self.accelerate(segment, T::from_f64(s), false)?;
            for i in 0..self.begin.q.len() {
                let (dq, dv) = (self.rates.q[i] / segment.h, self.rates.v[i] / segment.h);
                self.errors.q[i] += weight * (self.scratch.v[i] - dq).value();
                self.errors.v[i] += weight * (self.acceleration[i] - dv).value();
            }
            self.damp(segment, s, weight)?;
        }
        Ok(())
    }

    /// Errors as they are before a step: the difference of its ends, or nothing.
    fn start_errors(&mut self, difference: f64) {
        let q = [&mut self.errors.q, &mut self.sizes.q];
        let v = [&mut self.errors.v, &mut self.sizes.v];
        let ends = [(&self.begin.q, &self.last.q), (&self.begin.v, &self.last.v)];
        for ([errors, sizes], (begin, last)) in [q, v].into_iter().zip(ends) {
            for i in 0..begin.len() {
                errors[i] = difference * (begin[i] - last[i]);
                sizes[i] = begin[i].abs().max(last[i].abs());
            }
        }
    }

    /// State, its derivatives and accelerations at part `s` of a step, by the equations that the run itself evaluates; remembers how large the state is.
    /// The state may be moved `onto` the constraints before: near a loss of rank what it is off by, which is looked at for itself, changes accelerations much.
    pub(super) fn accelerate(
        &mut self,
        segment: &Segment<T>,
        s: T,
        onto: bool,
    ) -> Result<(), Error> {
        let State { q, v, .. } = &mut self.scratch;
        let lists = [(&mut *q, &mut self.rates.q), (&mut *v, &mut self.rates.v)];
        for (which, (values, rates)) in lists.into_iter().enumerate() {
            for (i, (x, rate)) in values.iter_mut().zip(rates).enumerate() {
                let c = self.record.polynomial(segment, which, i);
                (*x, *rate) = with_derivative(c, s);
            }
        }
        self.accelerate_there(segment, s, onto)?;
        let State { q, v, .. } = &self.scratch;
        for (sizes, list) in [(&mut self.sizes.q, q), (&mut self.sizes.v, v)] {
            let pairs = sizes.iter_mut().zip(list);
            pairs.for_each(|(size, x)| *size = size.max(x.value().abs()));
        }
        Ok(())
    }

    /// Accelerations at part `s` of a step in the state taken.
    fn accelerate_there(&mut self, segment: &Segment<T>, s: T, onto: bool) -> Result<(), Error> {
        let State { q, v, .. } = &mut self.scratch;
        let time = segment.t + segment.h * s;
        let mode = &self.record.modes[segment.mode];
        if onto {
            // Where no state nearby satisfies the constraints, that is told by them.
            _ = self.dynamics.project(time, q, v, 0.0);
        }
        let outcome = if !mode.has_incipient_slip() {
            Acceleration::acceleration(&mut self.dynamics, time, q, v, &mut self.acceleration)
        } else {
            let left = &self.left;
            let outcome = self.dynamics.value_along_from(time, q, v, left);
            self.acceleration
                .copy_from_slice(self.dynamics.acceleration());
            outcome
        };
        let d = self.record.description();
        outcome.map_err(|e| Error::from_evaluation(e, time.value(), mode, d))
    }

    /// Takes from the errors that [`Self::integrate`] has found what rounding of positions makes of the accelerations: much where constraints are about to
    /// lose rank.
    pub(super) fn discount_rounding(&mut self, segment: &Segment<T>) -> Result<(), Error> {
        let (h, end) = (segment.h.value(), segment.end.value());
        for k in 0..self.nodes.len() {
            let (x, w) = self.nodes[k];
            let s = T::from_f64(0.5 * end * (1.0 + x));
            let weight = 0.5 * end * h * w;
            self.accelerate(segment, s, true)?;
            let exact = self.acceleration.clone();
            let mut blur = vec![0.0_f64; exact.len()];
            for alternates in [false, true] {
                let State { q, v, .. } = &mut self.scratch;
                self.record.state_at(segment, s, q, v);
                for (j, q) in q.iter_mut().enumerate() {
                    let sign = if alternates && j % 2 == 1 { -1.0 } else { 1.0 };
                    *q *= T::from_f64(1.0 + sign * ULPS * epsilon::<T>());
                }
                self.accelerate_there(segment, s, true)?;
                for ((blur, a), exact) in blur.iter_mut().zip(&self.acceleration).zip(&exact) {
                    *blur = blur.max((*a - *exact).value().abs());
                }
            }
            for (error, blur) in self.errors.v.iter_mut().zip(blur) {
                *error -= error.clamp(-weight * blur, weight * blur);
            }
        }
        Ok(())
    }

    /// What is left of the errors after a time h, (1 − h J)⁻¹ of them, J the Jacobian at part `s` of a step: an error of the
    /// dense output in a motion that is damped fast changes the accelerations by far more, but for a short time only.
    pub(super) fn damp(&mut self, segment: &Segment<T>, s: f64, h: f64) -> Result<(), Error> {
        let d = self.record.description();
        let s = T::from_f64(s);
        let (time, n) = (segment.t + segment.h * s, self.last.q.len());
        let State { q, v, .. } = &mut self.scratch;
        self.record.state_at(segment, s, q, v);
        // A slip that has begun goes along itself there.
        self.dynamics.set_mode(&self.modes[segment.mode]);
        let mut columns = vec![T::zero(); 2 * n * n];
        let outcome = self.dynamics.jacobian(time, q, v, &mut columns);
        let mode = &self.record.modes[segment.mode];
        outcome.map_err(|e| Error::from_evaluation(e, time.value(), mode, d))?;
        let rate = |i: usize, j: usize| match i.checked_sub(n) {
            Some(i) => columns[j * n + i].value(),
            None => f64::from(u8::from(j == i + n)),
        };
        let unit = |i: usize, j: usize| f64::from(u8::from(i == j));
        let matrix = DMatrix::from_fn(2 * n, 2 * n, |i, j| unit(i, j) - h * rate(i, j));
        let State { q, v, .. } = &mut self.errors;
        let errors = DVector::from_iterator(2 * n, q.iter().chain(v.iter()).copied());
        // What the Jacobian of a slip that has all but vanished makes of them is no number of theirs.
        if let Some(left) = matrix.lu().solve(&errors)
            && left.amax() <= errors.amax()
        {
            let errors = q.iter_mut().chain(v);
            errors
                .zip(left.iter())
                .for_each(|(error, left)| *error = *left);
        }
        Ok(())
    }
}

/// Σ cₖ sᵏ and Σ k cₖ sᵏ⁻¹.
fn with_derivative<T: Scalar>(c: &[T], s: T) -> (T, T) {
    let coefficients = c.iter().rev();
    coefficients.fold((T::zero(), T::zero()), |(value, rate), &c| {
        (value * s + c, rate * s + value)
    })
}
