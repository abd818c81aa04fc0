//! What errors are measured against: a closed form, or the tightest run there is, checked by another method.
//!
//! Two references that have nothing in common but the scene differ by the errors of both. Below that difference, the
//! floor, no error of a run can be told.

use super::Setting;
use super::course::{Course, Finish, finish};
use crate::closed_form::ClosedForm;
use crate::request::Refusal;
use lagrange_core::prelude::*;

/// The tightest run: Taylor series of the highest order.
const TIGHTEST: Setting = Setting {
    method: Method::Taylor,
    tolerance: 1e-16,
};

/// The runs that check it, by methods that have nothing in common with it.
const CHECKS: [Setting; 2] = [
    Setting {
        method: Method::Verner98,
        tolerance: 1e-15,
    },
    Setting {
        method: Method::DormandPrince853,
        tolerance: 1e-15,
    },
];

/// Steps of the Taylor method are the radius of convergence over e² (Jorba & Zou 2005).
const RADIUS_PER_STEP: f64 = 7.389_056_098_930_65;

/// What happens, exactly as far as known.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// What it is: `taylor at 1e-16`, or the name of a closed form.
    pub by: String,
    /// What was compared with it.
    pub checked_by: String,
    /// Largest difference between the two.
    pub difference: f64,
    /// Below this an error cannot be told.
    pub floor: f64,
    /// Events in order of time: item and kind (`rim lost`), time in s.
    pub events: Vec<(String, f64)>,
    /// Time of the end, s.
    pub time: f64,
    /// State at the end.
    pub state: State<f64>,
}

impl Reference {
    /// Errors of the final state and of the times of the events, if there are any.
    ///
    /// # Errors
    /// Something else happened.
    pub(super) fn errors(&self, found: &Finish) -> Result<(f64, Option<f64>), String> {
        let labels = |events: &[(String, f64)]| -> Vec<String> {
            events.iter().map(|(label, _)| label.clone()).collect()
        };
        let (happened, expected) = (labels(&found.events), labels(&self.events));
        if happened != expected {
            let list = |labels: Vec<String>| match labels.is_empty() {
                true => "nothing".to_owned(),
                false => labels.join(", "),
            };
            return Err(format!(
                "other events: {} instead of {}",
                list(happened),
                list(expected)
            ));
        }
        let values =
            |state: &State<f64>| -> Vec<f64> { state.q.iter().chain(&state.v).copied().collect() };
        let state = largest(&values(&found.state), &values(&self.state)).unwrap_or(0.0);
        let times = |events: &[(String, f64)]| -> Vec<f64> { events.iter().map(|e| e.1).collect() };
        Ok((state, largest(&times(&found.events), &times(&self.events))))
    }

    fn difference(&self, found: &Finish) -> Result<f64, String> {
        let (state, events) = self.errors(found)?;
        Ok(state.max(events.unwrap_or(0.0)))
    }
}

/// max |found − wanted| / max(1, |wanted|)
fn largest(found: &[f64], wanted: &[f64]) -> Option<f64> {
    let pairs = found.iter().zip(wanted);
    pairs
        .map(|(found, wanted)| (found - wanted).abs() / wanted.abs().max(1.0))
        .reduce(f64::max)
}

/// The reference of a run, and the time scale of its motion, s.
pub(super) fn reference<S: System<Scalar = f64>>(
    course: &Course<S>,
    closed_form: Option<ClosedForm>,
) -> Result<(Reference, f64), Refusal> {
    let tightest = course.run(TIGHTEST).map_err(|error| Refusal::Reference {
        by: TIGHTEST.to_string(),
        reason: error.to_string(),
    })?;
    let steps = tightest.work().steps.max(1);
    let scale = RADIUS_PER_STEP * (tightest.last_time() - tightest.first_time()) / steps as f64;
    let reference = match closed_form {
        Some(known) => from_closed_form(known, finish(&tightest)),
        None => from_runs(course, finish(&tightest)),
    };
    Ok((reference?, scale))
}

fn from_closed_form(known: ClosedForm, run: Finish) -> Result<Reference, Refusal> {
    let events = known.events.into_iter();
    let reference = Reference {
        by: format!("the closed form ({})", known.by),
        checked_by: TIGHTEST.to_string(),
        difference: 0.0,
        floor: known.rounding,
        events: events
            .map(|(label, time)| (label.to_owned(), time))
            .collect(),
        time: known.time,
        state: known.state,
    };
    let difference = reference
        .difference(&run)
        .map_err(|reason| Refusal::Reference {
            by: TIGHTEST.to_string(),
            reason,
        })?;
    Ok(Reference {
        difference,
        ..reference
    })
}

/// The tightest run, with the one of the checks that agrees best.
fn from_runs<S: System<Scalar = f64>>(
    course: &Course<S>,
    tightest: Finish,
) -> Result<Reference, Refusal> {
    let reference = Reference {
        by: TIGHTEST.to_string(),
        checked_by: String::new(),
        difference: f64::INFINITY,
        floor: f64::INFINITY,
        events: tightest.events,
        time: tightest.time,
        state: tightest.state,
    };
    let check = |setting: Setting| -> Result<f64, Refusal> {
        let run = course.run(setting).map_err(|error| error.to_string());
        run.and_then(|run| reference.difference(&finish(&run)))
            .map_err(|reason| Refusal::Reference {
                by: setting.to_string(),
                reason,
            })
    };
    let checks = CHECKS.map(|setting| check(setting).map(|difference| (setting, difference)));
    let best = checks
        .iter()
        .flatten()
        .min_by(|(_, a), (_, b)| a.total_cmp(b));
    match best {
        Some(&(setting, difference)) => Ok(Reference {
            checked_by: setting.to_string(),
            difference,
            floor: difference.max(f64::EPSILON),
            ..reference
        }),
        None => {
            let [first, _] = checks;
            Err(first.err().unwrap_or(Refusal::Reference {
                by: reference.by,
                reason: "nothing to check it by".to_owned(),
            }))
        }
    }
}
