//! Steps that are bounded by stability: a fast motion has long been damped away, what is left is smooth, and yet explicit steps stay
//! short.
//!
//! A step of length h multiplies what is left of a component with rate λ by a polynomial in h λ, which is small up to some |h λ| only (for
//! Taylor series of order p about p/e). Codes estimate |h λ| from their stages and compare it with that bound (Hairer & Wanner,
//! Solving Ordinary Differential Equations II (1996), section IV.2). Whether a change of the method pays shows more directly: a step of Radau
//! that is many times longer keeps the tolerance. Where accuracy bounds the steps none of order 5 does, since Taylor series are of
//! higher order. Such a step is tried only after many steps without a switch, and counts only where the motion is damped.

use super::Run;
use crate::arithmetic::Scalar;
use crate::dynamics::EvaluationError;
use crate::integrate::{Acceleration, Integrator, Method, taylor};
use crate::trajectory::State;

/// So many steps lie between two looks; after a trial in vain, as many as there were before.
const LOOK: usize = 64;
/// Radau makes the steps where it can make them this much longer, and the motion is damped, see [`DAMPED`].
const LONGER: f64 = 20.0;
/// Radau makes the steps only where the rates at which the motion is damped add up to this over one of them: a stiff spring without a damper
/// keeps its motion, even if that is far below the tolerance.
const DAMPED: f64 = 1.0;
/// Radau makes the steps no more once they, which cost more, are not this much longer.
const WORTH: f64 = 4.0;

/// What is known about the stiffness of a run.
#[derive(Debug)]
pub(super) struct Stiffness<T> {
    method: Method,
    /// Steps since the last switch or change of the method.
    steps: usize,
    /// After how many steps the next look is due.
    due: usize,
    /// When the steps were found to be bounded by stability, unless they no longer are.
    pub(super) since: Option<f64>,
    /// Radau, once it was needed, while it does not make the steps.
    radau: Option<Box<Integrator<T>>>,
}

impl<T: Scalar> Stiffness<T> {
    pub(super) fn new(method: Method) -> Self {
        Stiffness {
            method,
            steps: 0,
            due: LOOK,
            since: None,
            radau: None,
        }
    }

    /// Begins to watch anew, with the method that was asked for.
    pub(super) fn restart(&mut self, present: &mut Option<Box<Integrator<T>>>) {
        (self.steps, self.due, self.since) = (0, LOOK, None);
        if self.method == Method::Auto {
            self.radau = present.take().or(self.radau.take());
        }
    }

    /// Whether the method is one whose steps stability can bound: explicit, and of lengths of its own.
    fn watches(&self) -> bool {
        match self.method {
            Method::Auto
            | Method::Taylor
            | Method::DormandPrince853
            | Method::DormandPrince54
            | Method::Verner98 => true,
            Method::Radau5 | Method::RungeKutta4 { .. } | Method::Gauss6 { .. } => false,
        }
    }
}

impl<T: Scalar> Run<T> {
    /// Looks from time to time whether stability bounds the steps, and chooses by that what makes them.
    pub(super) fn watch_stiffness(&mut self) {
        self.stepper.stiffness.steps += 1;
        if self.stepper.stiffness.steps < self.stepper.stiffness.due
            || !self.stepper.stiffness.watches()
        {
            return;
        }
        self.stepper.stiffness.due += LOOK;
        let changes = self.stepper.stiffness.method == Method::Auto;
        if self.stepper.stiffness.since.is_none() {
            let Some(h) = self.smooth_for() else {
                return;
            };
            if !self.goes_far(LONGER * h) {
                self.stepper.stiffness.due = 2 * self.stepper.stiffness.steps;
                return;
            }
            self.stepper.stiffness.since = Some(self.now.t.value());
            if changes {
                self.stepper.other = self.stepper.stiffness.radau.take();
                self.stepper.wanted = Some(LONGER * h);
            }
        } else if changes
            && let Some(h) = self.stepper.wanted
            && self.expand().is_ok()
        {
            let series = taylor::step_size(
                self.dynamics.state_series(),
                self.stepper.order,
                self.settings.per_step(),
            );
            if series.is_some_and(|series| WORTH * series > h) {
                self.leave_stiffness();
            }
        }
    }

    /// The motion is another one from here on, or its steps are no longer bounded by stability: the method that was asked for goes on,
    /// without a memory.
    pub(super) fn leave_stiffness(&mut self) {
        self.note_stiffness();
        self.stepper.restart();
    }

    /// Writes down since when the steps have been bounded by stability, if they are.
    pub(super) fn note_stiffness(&mut self) {
        if let Some(since) = self.stepper.stiffness.since {
            self.recorder
                .trajectory
                .stiff
                .push(since..self.now.t.value());
        }
    }

    /// Length of the explicit step from the present state, if nothing shows that accuracy bounds it: terms of low order of Taylor
    /// series are then far above the allowed error, as those of high order reach it only at the end of the step.
    fn smooth_for(&mut self) -> Option<f64> {
        const LOW: usize = 3;
        self.expand().ok()?;
        let (dynamics, tolerance) = (&self.dynamics, self.settings.per_step());
        let h = if self.stepper.is_taylor() {
            taylor::step_size(dynamics.state_series(), self.stepper.order, tolerance)
        } else {
            self.stepper.wanted
        };
        h.filter(|h| {
            let most = h.powi(-(LOW as i32)) / tolerance.strictness().sqrt();
            (0..self.now.state.q.len()).all(|i| {
                let rows = [dynamics.position_series(i), dynamics.velocity_series(i)];
                rows.into_iter().all(|row| {
                    let allowed = tolerance.scale(i, row[0].value().abs());
                    row[LOW].value().abs() <= most * allowed
                })
            })
        })
    }

    /// Whether Radau makes a step of this length from the present state at once.
    fn goes_far(&mut self, h: f64) -> bool {
        if h > self.end - self.now.t.value() {
            return false;
        }
        let n = self.now.state.q.len();
        let new = || Integrator::new(Method::Radau5, n).map(Box::new);
        self.stepper.stiffness.radau = self.stepper.stiffness.radau.take().or_else(new);
        let Some(radau) = &mut self.stepper.stiffness.radau else {
            return false;
        };
        radau.restart();
        let (from, tolerance) = (self.now.start(), self.settings.per_step());
        let (dynamics, step) = (&mut self.dynamics, &mut self.stepper.step);
        let outcome = radau.step(dynamics, from, h, tolerance, step);
        // The trial has left other values in their place.
        self.now.outdate();
        outcome.is_ok_and(|accepted| accepted.rejected == 0)
            && self.damping().is_ok_and(|rate| rate * h >= DAMPED)
    }

    /// −tr ∂v̇/∂v at the present state, 1/s: the rate at which volumes of states shrink.
    fn damping(&mut self) -> Result<f64, EvaluationError> {
        let n = self.now.state.q.len();
        let [mut by_q, mut by_v] = [0, 1].map(|_| vec![0.0; n * n]);
        let State { q, v, .. } = &self.now.state;
        Acceleration::jacobian(&mut self.dynamics, self.now.t, q, v, &mut by_q, &mut by_v)?;
        Ok(-by_v.iter().step_by(n + 1).sum::<f64>())
    }
}
