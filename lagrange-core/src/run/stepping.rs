//! What makes a step, by Taylor series or by another method: polynomials of the motion and of all guards.

use super::hit::Hit;
use super::resolution::Resolution;
use super::stiffness::Stiffness;
use super::{Progress, Run};
use crate::arithmetic::products::{ROW, Row};
use crate::arithmetic::{Scalar, epsilon};
use crate::dynamics::{self, EvaluationError};
use crate::effects::Item;
use crate::error::Error;
use crate::integrate::taylor::{self, Costs, DefectControl};
use crate::integrate::{Integrator, Method, StepPolynomial};
use crate::settings::Settings;
use crate::system::Description;
use crate::trajectory::State;

/// A slip close to its rest is looked at from this part of the way.
pub(super) const JUST_BEFORE: f64 = 0.999;

/// Parts of the way to an instant at which its forces are looked for.
const AT_OR_BEFORE: [f64; 6] = [1.0, 0.999, 0.99, 0.9, 0.7, 0.4];

/// Careful steps begin at this share of what the method would begin with.
pub(super) const CAREFUL: f64 = 0.5;

/// So many times a step is made shorter for what it hides.
const MOST_SHORTENED: usize = 16;

/// Before anything has been seen of how steps come forward.
const NOT_LOOKED: (usize, f64) = (0, f64::NEG_INFINITY);

/// What makes the polynomials of a step, and the step at hand.
#[derive(Debug)]
pub(super) struct Stepper<T> {
    /// Order of Taylor series.
    pub(super) order: usize,
    /// Judges the steps of Taylor series.
    pub(super) control: DefectControl,
    /// The method, if it is not that of Taylor series at present.
    pub(super) other: Option<Box<Integrator<T>>>,
    /// The step that this other method would like to take.
    pub(super) wanted: Option<f64>,
    /// Longest step of Taylor series for which guards that bend more than the motion are good, while they are what bounds the steps.
    pub(super) guarded: Option<f64>,
    /// The share by which directions of slips are off at the present state.
    pub(super) astray: f64,
    /// Breaks of guards that were passed since the last step that no guard has bounded so.
    pub(super) breaks: usize,
    /// The contact that the step ends at, if its gap has no direction there.
    pub(super) undirected: Option<&'static str>,
    /// Steps that had been tried in vain when that was looked at last, and the time.
    pub(super) looked: (usize, f64),
    pub(super) stiffness: Stiffness<T>,
    pub(super) resolution: Resolution,
    pub(super) step: StepPolynomial<T>,
    /// Length of the last step that was made.
    pub(super) made: f64,
    /// Powers of the step length, h⁰ … hᵖ.
    pub(super) powers: Row<f64>,
    /// State where the step ends.
    pub(super) scratch: State<T>,
    /// Σ k vₖ of the polynomials of the velocities.
    pub(super) slopes: Vec<f64>,
}

impl<T: Scalar> Stepper<T> {
    /// Room for the steps of states like this one.
    pub(super) fn new(settings: &Settings, d: &Description, state: &State<T>) -> Self {
        let n = state.q.len();
        let effects = &settings.effects;
        let acts = |i: &usize| effects.includes(d, Item::Constraint(*i));
        let costs = Costs {
            products: dynamics::products(d, effects),
            coordinates: n,
            constraints: (0..d.constraints.len()).filter(acts).count(),
        };
        Stepper {
            order: taylor::order(settings.per_step(), costs),
            control: DefectControl::default(),
            other: Integrator::new(settings.method, n).map(Box::new),
            wanted: None,
            guarded: None,
            astray: 0.0,
            breaks: 0,
            undirected: None,
            looked: NOT_LOOKED,
            stiffness: Stiffness::new(settings.method),
            resolution: Resolution::default(),
            step: StepPolynomial::new(n, 1),
            made: 0.0,
            powers: [0.0; ROW],
            scratch: state.clone(),
            slopes: vec![0.0; n],
        }
    }

    /// Whether the steps are those of Taylor series.
    pub(super) fn is_taylor(&self) -> bool {
        self.other.is_none()
    }

    /// Whether an explicit method chooses the steps.
    pub(super) fn is_explicit(&self) -> bool {
        let method = self.other.as_deref();
        method.is_some_and(Integrator::is_explicit_and_adaptive)
    }

    /// Forgets what belongs to another motion; the method is the one that was asked for.
    pub(super) fn restart(&mut self) {
        self.control = DefectControl::default();
        (self.wanted, self.guarded, self.undirected) = (None, None, None);
        (self.breaks, self.looked) = (0, NOT_LOOKED);
        self.astray = 0.0;
        self.resolution = Resolution::default();
        if let Some(method) = &mut self.other {
            method.restart();
        }
        self.stiffness.restart(&mut self.other);
    }
}

impl<T: Scalar> Run<T> {
    /// Makes a step from the present state and finds what happens first in it.
    pub(super) fn accepted_step(&mut self) -> Result<Hit, Error> {
        self.stepper.made = self.stepper.step.h.value();
        if self.stepper.is_taylor() {
            return self.taylor_step();
        }
        self.stepper.control = DefectControl::default();
        let hit = self.sampled_step();
        if hit.is_err() && self.settings.method == Method::Auto {
            // What Radau cannot do may still be within reach of Taylor series.
            self.leave_stiffness();
            return self.taylor_step();
        }
        hit
    }

    /// The length of a step that hides nothing from a method of this order, if that at hand, up to `end`, is longer; it has been shortened so
    /// many times for that.
    pub(super) fn hides(&mut self, end: f64, order: usize, shortened: usize) -> Option<f64> {
        let hidden = self.hidden.as_mut()?;
        // An exponent that jumps (at the cut of an atan2) does so in all steps.
        if shortened == MOST_SHORTENED {
            return None;
        }
        let part = hidden.shown(&self.stepper.step, end, order);
        (part < end).then(|| part * self.stepper.step.h.value())
    }

    /// Whether time is another after a step.
    pub(super) fn advances(&self, h: f64) -> bool {
        (self.now.t + T::from_f64(h)).value() > self.now.t.value()
    }

    /// Shorter steps do not advance time clearly within the next `h`.
    pub(super) fn resolution(&self, h: f64) -> f64 {
        let now = self.now.t.value();
        2.0 * epsilon::<T>() * now.abs().max((now + h).abs())
    }

    /// The state at part `end` of the step, in `scratch`, and the equations of motion there.
    pub(super) fn evaluate_end(&mut self, end: f64) -> Result<(), EvaluationError> {
        self.state_at_end(end);
        self.evaluate_scratch(end)
    }

    /// What can be told of the state at part `end` of the step: forces are no numbers where constraints lose rank.
    pub(super) fn look_at_end(&mut self, end: f64) {
        if self.evaluate_end(end).is_err() {
            let State { q, v, .. } = &self.stepper.scratch;
            let time = self.stepper.step.time(T::from_f64(end));
            self.dynamics.tape_without_forces(time, q, v);
        }
    }

    /// Evaluates the equations at part `end` of the step, or as close before it as they say something reliable: at a pole, where an angle has no inertia,
    /// and where constraints lose rank forces are known beside it only. The state at `end` is left in `scratch`.
    pub(super) fn evaluate_at_or_before(&mut self, end: T) {
        for part in AT_OR_BEFORE {
            let place = end * T::from_f64(part);
            let (step, State { q, v, .. }) = (&self.stepper.step, &mut self.stepper.scratch);
            step.state_into(place, q, v);
            let known = self.dynamics.value_along(step.time(place), q, v);
            if known.is_ok() && self.rank.distance(&self.dynamics) >= self.least_distance() {
                break;
            }
        }
        let State { q, v, .. } = &mut self.stepper.scratch;
        self.stepper.step.state_into(end, q, v);
    }

    /// The equations of motion for the state at part `end` of the step, moved onto the constraints, in `scratch`.
    pub(super) fn evaluate_onto_constraints(&mut self, end: f64) -> Result<(), EvaluationError> {
        self.state_at_end(end);
        let State { q, v, .. } = &mut self.stepper.scratch;
        let time = self.stepper.step.time(T::from_f64(end));
        self.dynamics.project(time, q, v, 0.0)?;
        self.evaluate_scratch(end)
    }

    /// The equations of motion for the state in `scratch`, that at part `end` of the step.
    pub(super) fn evaluate_scratch(&mut self, end: f64) -> Result<(), EvaluationError> {
        let State { q, v, .. } = &self.stepper.scratch;
        let time = self.stepper.step.time(T::from_f64(end));
        self.dynamics.value_along(time, q, v)
    }

    /// The state at part `end` of the step, in `scratch`.
    pub(super) fn state_at_end(&mut self, end: f64) {
        let State { q, v, .. } = &mut self.stepper.scratch;
        self.stepper.step.state_into(T::from_f64(end), q, v);
    }

    /// Moves the state back onto the constraints of the mode where its residual calls for it (`always`: in any case).
    pub(super) fn project(&mut self, always: bool) -> Result<(), Error> {
        let tolerance = 1e-2 * self.settings.tolerance.max(1e-14);
        let outcome = self.dynamics.project(
            self.now.t,
            &mut self.now.state.q,
            &mut self.now.state.v,
            if always { 0.0 } else { tolerance },
        );
        match outcome {
            Ok(changed) => {
                self.recorder.trajectory.work.projections += usize::from(changed);
                self.now.valued &= !changed;
                if changed {
                    self.now.series = Progress::None;
                }
                Ok(())
            }
            Err(e) => Err(self.error(e)),
        }
    }
}
