//! One accepted step: polynomials of the motion and of all guards, checked against an independent evaluation.

use super::Run;
use super::hits::Hit;
use crate::arithmetic::Scalar;
use crate::error::Error;
use crate::integrate::taylor::{self, DefectControl, Verdict};
use crate::integrate::{Integrator, Method, StepError};
use crate::system::System;

/// A step may come nearer to a position where the constraints lose rank, or to its other side, by this factor.
const NEARER: f64 = 0.35;
/// Else it is tried this much longer, over that position,
const LEAP: f64 = 1.5;
/// if the error is no more than so many times what is allowed for a step,
const MOST_DEFECT: f64 = 30.0;
/// with any degree from this on,
const LEAST_DEGREE: usize = 6;
/// and then this much shorter,
const RETREAT: f64 = 0.75;
/// so many times.
const MOST_RETREATS: usize = 5;

/// What makes the polynomials of a step.
pub(super) enum Stepper<T> {
    /// Taylor series.
    Taylor(DefectControl),
    /// Another method and the step that it would like to take.
    Other(Box<Integrator<T>>, Option<f64>),
}

impl<T: Scalar> Stepper<T> {
    pub(super) fn new(method: Method, coordinates: usize) -> Self {
        match Integrator::new(method, coordinates) {
            None => Stepper::Taylor(DefectControl::default()),
            Some(method) => Stepper::Other(Box::new(method), None),
        }
    }

    /// Forgets what belongs to the motion before a switch.
    pub(super) fn restart(&mut self) {
        match self {
            Stepper::Taylor(control) => *control = DefectControl::default(),
            Stepper::Other(method, wanted) => {
                method.restart();
                *wanted = None;
            }
        }
    }
}

impl<S: System> Run<'_, S> {
    /// Makes a step from the present state and finds what happens first in it.
    pub(super) fn accepted_step(&mut self) -> Result<Hit, Error> {
        match &self.stepper {
            Stepper::Taylor(_) => self.taylor_step(),
            Stepper::Other(..) => self.other_step(),
        }
    }

    fn taylor_step(&mut self) -> Result<Hit, Error> {
        if !self.expanded {
            let outcome = self
                .dynamics
                .series(self.t, &self.state.q, &self.state.v, self.order);
            outcome.map_err(|e| self.error(e))?;
            self.expanded = true;
        }
        let longest = self.end - self.t.value();
        let mut h = taylor::step_size(&self.dynamics, self.order, self.tolerance)
            .ok_or_else(|| self.not_finite("a Taylor coefficient"))?
            .min(longest);
        let mut closer = 0;
        loop {
            if self.t.value() + h <= self.t.value() {
                return Err(self.step_too_small(h));
            }
            self.write_polynomial(h, self.order);
            let mut curves = core::mem::take(&mut self.curves);
            curves.take_series(&self.dynamics, &self.mode, &self.guards, h);
            let hit = self.first_hit(&curves);
            self.curves = curves;
            let end = hit.end();
            if end == 0.0 {
                return Ok(hit);
            }
            // The next step's own first evaluation would do; made here, it also serves the event log.
            let s = S::Scalar::from_f64(end);
            self.step
                .state_into(s, &mut self.scratch.q, &mut self.scratch.v);
            let defect =
                match self
                    .dynamics
                    .value(self.step.time(s), &self.scratch.q, &self.scratch.v)
                {
                    Ok(()) => {
                        let motion = taylor::defect(
                            &self.step,
                            end,
                            self.dynamics.acceleration(),
                            self.tolerance,
                        );
                        let guards = self.curves.defect(
                            &mut self.dynamics,
                            &self.mode,
                            &self.guards,
                            end,
                            self.simulation.tolerance,
                        );
                        // Not the larger of a number and a NaN, which would be the number.
                        if guards <= motion { motion } else { guards }
                    }
                    Err(_) => f64::INFINITY,
                };
            let Stepper::Taylor(control) = &mut self.stepper else {
                return Ok(hit);
            };
            // A step must not end where the constraints lose rank.
            let distance = self.rank.distance(&self.dynamics);
            if distance < NEARER * self.distance && closer < MOST_RETREATS {
                if closer == 0 && self.leap(LEAP * h)? {
                    return Ok(Hit::Nothing);
                }
                closer += 1;
                self.trajectory.work.rejected += 1;
                h *= RETREAT;
                continue;
            }
            match control.judge(h, defect, self.order) {
                Verdict::Accept => {
                    self.distance = distance;
                    return Ok(hit);
                }
                Verdict::Redo { h: smaller } => {
                    self.trajectory.work.rejected += 1;
                    h = smaller;
                }
            }
        }
    }

    /// Tries a step of length `h` over a position where the constraints lose rank.
    ///
    /// Rounding enters the equations amplified and grows through the coefficients as if the solution had a pole there; the
    /// truncation error falls with the order. The order with the least defect beyond is the best compromise. False if none
    /// is good enough.
    fn leap(&mut self, h: f64) -> Result<bool, Error> {
        if h > self.end - self.t.value() {
            return Ok(false);
        }
        let mut best = (MOST_DEFECT, None);
        for degree in LEAST_DEGREE..=self.order {
            if let Some((defect, distance)) = self.beyond(h, degree)
                && defect < best.0
                && distance >= NEARER * NEARER * self.distance
            {
                best = (defect, Some(degree));
            }
        }
        let Some(degree) = best.1 else {
            return Ok(false);
        };
        match self.beyond(h, degree) {
            Some((_, distance)) => self.distance = distance,
            None => return Ok(false),
        }
        Ok(true)
    }

    /// Defect and distance from a loss of rank at the end of a step of length `h` with a polynomial of this degree; nothing
    /// if it cannot be evaluated there or something happens on the way.
    fn beyond(&mut self, h: f64, degree: usize) -> Option<(f64, f64)> {
        self.write_polynomial(h, degree);
        let mut curves = core::mem::take(&mut self.curves);
        curves.take_series(&self.dynamics, &self.mode, &self.guards, h);
        curves.truncate(degree);
        let hit = self.first_hit(&curves);
        self.curves = curves;
        let one = S::Scalar::from_f64(1.0);
        self.step
            .state_into(one, &mut self.scratch.q, &mut self.scratch.v);
        let time = self.step.time(one);
        let outcome = self
            .dynamics
            .value(time, &self.scratch.q, &self.scratch.v);
        if hit != Hit::Nothing || outcome.is_err() {
            return None;
        }
        let acceleration = self.dynamics.acceleration();
        let defect = taylor::defect(&self.step, 1.0, acceleration, self.tolerance);
        Some((defect, self.rank.distance(&self.dynamics)))
    }

    /// Scales the series, up to `degree`, onto a step of length `h`.
    fn write_polynomial(&mut self, h: f64, degree: usize) {
        self.step.set_degree(degree);
        self.step.t = self.t;
        self.step.h = S::Scalar::from_f64(h);
        let h = S::Scalar::from_f64(h);
        for i in 0..S::DESCRIPTION.coordinates.len() {
            let (q, v) = self.step.rows_mut(i);
            let mut power = num_traits::one::<S::Scalar>();
            let series = self
                .dynamics
                .position_series(i)
                .iter()
                .zip(self.dynamics.velocity_series(i));
            for ((q, v), (x, y)) in q.iter_mut().zip(v).zip(series) {
                *q = *x * power;
                *v = *y * power;
                power *= h;
            }
        }
    }

    fn other_step(&mut self) -> Result<Hit, Error> {
        let longest = self.end - self.t.value();
        let Stepper::Other(method, wanted) = &mut self.stepper else {
            return Ok(Hit::Nothing);
        };
        let (q, v) = (&self.state.q, &self.state.v);
        let first = match *wanted {
            Some(h) => Ok(h),
            None => method.first_step(&mut self.dynamics, self.t, q, v, longest, self.tolerance),
        };
        let outcome = first.and_then(|h| {
            let h = h.min(longest);
            method.step(
                &mut self.dynamics,
                self.t,
                q,
                v,
                h,
                self.tolerance,
                &mut self.step,
            )
        });
        match outcome {
            Ok(accepted) => {
                *wanted = Some(accepted.h_next);
                self.trajectory.work.rejected += accepted.rejected;
            }
            Err(StepError::Acceleration(e)) => return Err(self.error(e)),
            Err(StepError::TooSmall { h, .. }) => return Err(self.step_too_small(h)),
            Err(StepError::NoConvergence { h, .. }) => {
                let mode = self.mode.display(S::DESCRIPTION).to_string();
                return Err(Error::StepTooLarge {
                    time: self.t.value(),
                    step: h,
                    mode,
                });
            }
        }
        let mut curves = core::mem::take(&mut self.curves);
        let sampled = curves.sample(
            &mut self.dynamics,
            &self.mode,
            &self.guards,
            &self.step,
            &mut self.scratch.q,
            &mut self.scratch.v,
        );
        let hit = sampled.map(|()| self.first_hit(&curves));
        self.curves = curves;
        hit.map_err(|e| self.error(e))
    }

    fn step_too_small(&self, step: f64) -> Error {
        let mode = self.mode.display(S::DESCRIPTION).to_string();
        Error::StepTooSmall {
            time: self.t.value(),
            step,
            mode,
        }
    }

    fn not_finite(&self, what: &str) -> Error {
        let mode = self.mode.display(S::DESCRIPTION).to_string();
        Error::NotFinite {
            time: self.t.value(),
            mode,
            what: what.to_owned(),
        }
    }

    /// Moves the state back onto the constraints of the mode where its residual calls for it (`always`: in any case).
    pub(super) fn project(&mut self, always: bool) -> Result<(), Error> {
        let tolerance = 1e-2 * self.simulation.tolerance.max(1e-14);
        let outcome = self.dynamics.project(
            self.t,
            &mut self.state.q,
            &mut self.state.v,
            if always { 0.0 } else { tolerance },
        );
        match outcome {
            Ok(changed) => {
                self.trajectory.work.projections += usize::from(changed);
                Ok(())
            }
            Err(e) => Err(self.error(e)),
        }
    }
}
