//! Errors of a run, with the present instant and mode in them.

use super::Run;
use crate::arithmetic::Scalar;
use crate::dynamics::EvaluationError;
use crate::error::{Error, NotFinite};
use crate::integrate::StepError;
use crate::modes::guard::Guard;

impl<T: Scalar> Run<T> {
    /// Why the equations could not be evaluated at the present instant.
    pub(super) fn error(&self, error: EvaluationError) -> Error {
        let (time, d) = (self.now.t.value(), self.description());
        let contradicts = matches!(error, EvaluationError::Inconsistent { .. });
        match Error::from_evaluation(error, time, &self.now.mode, d) {
            Error::Singular {
                time, mode, items, ..
            } if contradicts && self.is_undecided() => Error::Singular {
                time,
                mode,
                items,
                reason: "constraints lose rank in this position, perhaps several at once, and the way on from it was not found; an \
                         offset of a part avoids it, another tolerance may pass it"
                    .to_owned(),
            },
            other => other,
        }
    }

    /// Why a method made no step from the present instant.
    pub(super) fn no_step(&self, error: StepError<EvaluationError>) -> Error {
        match error {
            StepError::Acceleration(e) => self.error(e),
            StepError::TooSmall { h, .. } => self.step_too_small(h),
            StepError::NoConvergence { h, .. } => self.step_too_large(h),
        }
    }

    /// A step of this size, the last that was tried, hardly changes the time.
    pub(super) fn step_too_small(&self, step: f64) -> Error {
        Error::StepTooSmall {
            time: self.now.t.value(),
            step,
            mode: self.mode_in_words(),
        }
    }

    /// The stages of a step of this fixed size do not converge.
    pub(super) fn step_too_large(&self, step: f64) -> Error {
        Error::StepTooLarge {
            time: self.now.t.value(),
            step,
            mode: self.mode_in_words(),
        }
    }

    /// What is named here is no finite number.
    pub(super) fn not_finite(&self, what: &str) -> Error {
        Error::NotFinite {
            time: self.now.t.value(),
            mode: self.mode_in_words(),
            what: what.to_owned(),
            item: None,
            cause: NotFinite::Domain,
        }
    }

    /// Something of a guard has no finite value here.
    pub(super) fn no_value_of(&self, what: &str, guard: Guard) -> Error {
        let d = self.description();
        let item = guard.name(d).unwrap_or(d.name);
        let limited = matches!(guard, Guard::Gap(c) if d.contacts[c].region.is_some());
        let beyond = match limited {
            true => {
                " (a gap needs a value outside of its region as well, as `if(x <= 1, …, 0)` gives it)"
            }
            false => "",
        };
        self.not_finite(&format!("{what} of `{item}`{beyond}"))
    }

    /// Whether no more happens than a run may have of it.
    pub(super) fn check_limit(
        &self,
        what: &'static str,
        count: usize,
        limit: usize,
    ) -> Result<(), Error> {
        let time = self.now.t.value();
        match count > limit {
            true => Err(Error::Limit { time, what, limit }),
            false => Ok(()),
        }
    }

    /// The present mode, as messages name it.
    pub(super) fn mode_in_words(&self) -> String {
        self.now.mode.display(self.description()).to_string()
    }
}
