//! What is behind an error of the motion: coefficients without meaning where it happened, or fixed steps that lost the motion.

use super::Run;
use super::acting::{acting, acting_values};
use crate::arithmetic::Scalar;
use crate::declaration::{Evaluator, Inputs};
use crate::error::{Error, NotFinite};
use crate::integrate::Method;
use crate::modes::domain;
use crate::trajectory::State;

/// A step whose accelerations miss the equations of motion by this share of themselves does not follow the motion.
const LOST: f64 = 0.1;
/// If it changes velocities over the step by more than this, relative to the largest or 1.
const SHOWS: f64 = 1e-3;

/// Halvings of a step.
const BISECTIONS: usize = 50;

/// Products of three numbers beyond this size, or its inverse, are beyond all numbers.
const LARGEST: f64 = 1e102;

/// Equations of motion, and their series, contain what is declared to powers of about this.
const RAISED: i32 = 8;

impl<T: Scalar> Run<T> {
    /// The error that says why the motion came to this one.
    #[cold]
    pub(super) fn cause(&mut self, error: Error) -> Error {
        match error {
            Error::Interrupted { .. }
            | Error::Limit { .. }
            | Error::OutOfReach { .. }
            | Error::StepTooLarge { .. } => error,
            _ => self
                .domain_left()
                .or_else(|| self.steps_too_long())
                .or_else(|| {
                    let error = self.extremal_constraint(&error)?;
                    self.take_back();
                    Some(error)
                })
                .or_else(|| self.jammed_contact(&error))
                .unwrap_or_else(|| self.overflow(error)),
        }
    }

    /// The same error, which says so if numbers overflow where one is not finite, or where none solves an impact.
    pub(super) fn overflow(&self, mut error: Error) -> Error {
        if let Error::NoImpact {
            time, mode, item, ..
        } = &mut error
            && self.is_out_of_range()
        {
            return Error::NotFinite {
                time: *time,
                mode: core::mem::take(mode),
                what: format!("the impulse of `{item}`"),
                item: None,
                cause: NotFinite::Range,
            };
        }
        if let Error::NotFinite {
            what, item, cause, ..
        } = &mut error
        {
            // Functions of a state that has gone far are large because of that.
            let has_gone_far = self.sizes_of_state().any(|size| size > LARGEST);
            if !has_gone_far && self.exponentials_overflow() {
                *cause = NotFinite::Exponential;
            } else if let Some((name, why)) = self.item_without_value() {
                (*what, *item) = (format!("`{name}`, with {why} in it,"), Some(name));
            } else if self.is_out_of_range() {
                *cause = NotFinite::Range;
            }
        }
        error
    }

    /// The first item that has no finite value at the present state, and what makes it so.
    fn item_without_value(&self) -> Option<(&'static str, String)> {
        let system = self.dynamics.system();
        let acting = acting_values(system, self.dynamics.effects());
        let wanted = acting.iter().map(|(_, value)| *value);
        let evaluator = self.evaluated(wanted);
        let mut acting = acting.into_iter();
        acting.find_map(|(item, value)| {
            let known = evaluator.follows_state(value) && !evaluator.value(value).is_finite();
            let why = known.then(|| evaluator.why_not_finite(value)).flatten()?;
            Some((item.name(self.description()), why))
        })
    }

    /// An item whose logarithm has derivatives at the present state, and no value.
    pub(super) fn check_logarithms(&self) -> Result<(), Error> {
        match self.has_logarithms && self.item_without_value().is_some() {
            // Its name is told by whoever looks for the cause.
            true => Err(self.not_finite(self.description().name)),
            false => Ok(()),
        }
    }

    /// Declared values at the present state, as far as they need no accelerations and forces.
    fn evaluated(&self, wanted: impl IntoIterator<Item = usize>) -> Evaluator {
        let system = self.dynamics.system();
        let mut evaluator = Evaluator::new(system.declaration(), &system.parameters(), wanted);
        let State { q, v, .. } = &self.now.state.values();
        evaluator.evaluate(Inputs {
            time: self.now.t.value(),
            q,
            v,
            acceleration: &vec![0.0; q.len()],
            forces: &vec![0.0; self.description().rows.len()],
            loads: &vec![0.0; self.description().forces.len()],
        });
        evaluator
    }

    /// Whether functions in what acts are so large at the present state that powers of them are beyond all numbers.
    fn exponentials_overflow(&self) -> bool {
        let system = self.dynamics.system();
        let acting = acting(system, self.dynamics.effects());
        let growing: Vec<usize> = acting.exponentials().collect();
        let evaluator = self.evaluated(growing.iter().copied());
        growing.into_iter().any(|value| {
            let size = evaluator.value(value).powi(RAISED);
            evaluator.follows_state(value) && size.is_infinite()
        })
    }

    /// The sizes of all coordinates and velocities.
    fn sizes_of_state(&self) -> impl Iterator<Item = f64> + '_ {
        let State { q, v, .. } = &self.now.state;
        q.iter().chain(v).map(|x| x.value().abs())
    }

    /// Whether parameters, the state or its accelerations are of a size that products leave the range of numbers with.
    fn is_out_of_range(&self) -> bool {
        let parameters = self.dynamics.system().parameters().into_iter();
        let accelerations = self.dynamics.acceleration().iter().map(|x| x.value());
        let others = parameters.chain(accelerations).map(f64::abs);
        let mut sizes = self.sizes_of_state().chain(others);
        sizes.any(|size| size > LARGEST || size > 0.0 && size < LARGEST.recip())
    }

    /// A number that is outside its domain at the present state.
    fn domain_left(&mut self) -> Option<Error> {
        self.dynamics.set_mode(&self.now.mode);
        self.evaluate_all_rows().ok()?;
        domain::check(
            &self.dynamics,
            &self.now.mode,
            self.now.t.value(),
            &mut self.switcher.status.form,
        )
        .err()
    }

    /// Where a friction begins to push within the step up to part `end` of it, whose values `dynamics` holds, because its strength follows from
    /// the state and falls below zero; and the error.
    pub(super) fn friction_that_pushes(&mut self, end: f64) -> Option<(f64, Error)> {
        if !self.strengths_vary || end == 0.0 || !self.locator.rests.is_empty() {
            return None;
        }
        let check = |run: &Self, s: f64| {
            let time = run.stepper.step.time(T::from_f64(s)).value();
            domain::check_acting(&run.dynamics, time).err()
        };
        let (mut good, mut bad) = (0.0, (end, check(self, end)?));
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (good + bad.0);
            if self.evaluate_end(middle).is_err() {
                break;
            }
            match check(self, middle) {
                Some(error) => bad = (middle, error),
                None => good = middle,
            }
        }
        self.state_at_end(bad.0);
        Some(bad)
    }

    /// Whether the method's steps are fixed, and the last one has lost the motion.
    fn steps_too_long(&mut self) -> Option<Error> {
        if self.stepper.step.h.is_zero() {
            return None;
        }
        let accepted = self.recorder.trajectory.segments.last();
        let mode = match accepted {
            Some(segment) if self.stepper.step.t != self.now.t => {
                &self.recorder.trajectory.modes[segment.mode]
            }
            _ => &self.now.mode,
        };
        self.dynamics.set_mode(mode);
        let mode = mode.display(self.description()).to_string();
        let step = self.loses_motion()?;
        let time = self.stepper.step.t.value();
        Some(Error::StepTooLarge { time, step, mode })
    }

    /// The fixed step of the method, if half-way through the step at hand the equations of motion ask for other accelerations than
    /// it has.
    pub(super) fn loses_motion(&mut self) -> Option<f64> {
        let (Method::RungeKutta4 { step } | Method::Gauss6 { step }) = self.settings.method else {
            return None;
        };
        let half = T::from_f64(0.5);
        let State { q, v, .. } = &mut self.stepper.scratch;
        self.stepper.step.state_into(half, q, v);
        let valued = self.dynamics.value(self.stepper.step.time(half), q, v);
        let (mut defect, mut size) = (0.0_f64, 0.0_f64);
        for (i, asked) in self.dynamics.acceleration().iter().enumerate() {
            let (asked, has) = (
                asked.value(),
                self.stepper.step.acceleration(i, half).value(),
            );
            defect = defect.max((asked - has).abs());
            size = size.max(asked.abs()).max(has.abs());
        }
        let speed = v
            .iter()
            .fold(1.0_f64, |speed, v| speed.max(v.value().abs()));
        let shows = defect * self.stepper.step.h.value() > SHOWS * speed;
        let follows = valued.is_ok() && !(defect > LOST * size && shows) && defect.is_finite();
        (!follows).then_some(step)
    }
}
