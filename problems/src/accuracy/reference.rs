//! What errors are measured against: a closed form, or the tightest run there is, checked by another method.
//!
//! Two references that have nothing in common but the scene differ by the errors of both. Below that difference, the
//! floor, no error of a run can be told.

use super::Setting;
use super::course::{Course, Finish, finish};
use crate::closed_form::ClosedForm;
use crate::request::Refusal;
use lagrange_core::prelude::*;

/// The tightest run: Taylor series, at the first of these tolerances that gets to the end.
const TIGHTEST: [Setting; 4] = [taylor(1e-16), taylor(1e-15), taylor(1e-14), taylor(1e-13)];

/// Groups of runs that check it; of the first group with one that gets to the end, the one that agrees best. Other
/// methods, as tight as they can be; where none gets there, the same one with series of another order.
const CHECKS: [&[Setting]; 4] = [
    &explicit(1e-15),
    &explicit(1e-13),
    &explicit(1e-11),
    &[taylor(1e-12)],
];

const fn taylor(tolerance: f64) -> Setting {
    Setting {
        method: Method::Taylor,
        tolerance,
    }
}

const fn explicit(tolerance: f64) -> [Setting; 2] {
    [
        Setting {
            method: Method::Verner98,
            tolerance,
        },
        Setting {
            method: Method::DormandPrince853,
            tolerance,
        },
    ]
}

/// Runs that differ by more have not found the same motion.
const SAME: f64 = 1e-3;

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
            return Err(format!(
                "other events: {} instead of {}",
                list(&happened),
                list(&expected)
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

/// The difference, if it is one between two accounts of the same motion.
fn agreement(difference: f64) -> Result<f64, String> {
    match difference < SAME {
        true => Ok(difference),
        false => Err(format!("ends elsewhere, by {difference:.1e}")),
    }
}

/// `rim impact ×3, rim closed`
fn list(labels: &[String]) -> String {
    let runs = labels.chunk_by(|a, b| a == b).map(|run| match run {
        [one] => one.clone(),
        many => format!("{} ×{}", many[0], many.len()),
    });
    let runs: Vec<String> = runs.collect();
    match runs.is_empty() {
        true => "nothing".to_owned(),
        false => runs.join(", "),
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
    let (setting, tightest) = tightest(course)?;
    let steps = tightest.work().steps.max(1);
    let scale = RADIUS_PER_STEP * (tightest.last_time() - tightest.first_time()) / steps as f64;
    let finish = finish(&tightest);
    let reference = match closed_form {
        Some(known) => from_closed_form(known, setting, &finish),
        None => {
            // A check that gets stuck in ever smaller steps is of no use, and takes long.
            let patient = Course {
                start: course.start.clone(),
                simulation: course.simulation.clone(),
                max_steps: (10_000 + 100 * steps).min(course.max_steps),
                ..*course
            };
            from_runs(&patient, setting, finish)
        }
    };
    Ok((reference?, scale))
}

fn tightest<S: System<Scalar = f64>>(
    course: &Course<S>,
) -> Result<(Setting, Trajectory<S>), Refusal> {
    let mut refused = None;
    for setting in TIGHTEST {
        match course.run(setting) {
            Ok(run) => return Ok((setting, run)),
            Err(error) => refused = refused.or(Some(refusal(setting, error.to_string()))),
        }
    }
    Err(refused.unwrap_or_else(|| refusal(TIGHTEST[0], "nothing was run".to_owned())))
}

fn refusal(setting: Setting, reason: String) -> Refusal {
    Refusal::Reference {
        by: setting.to_string(),
        reason,
    }
}

fn from_closed_form(
    known: ClosedForm,
    checked_by: Setting,
    run: &Finish,
) -> Result<Reference, Refusal> {
    let events = known.events.into_iter();
    let reference = Reference {
        by: format!("the closed form ({})", known.by),
        checked_by: checked_by.to_string(),
        difference: 0.0,
        floor: known.rounding,
        events: events
            .map(|(label, time)| (label.to_owned(), time))
            .collect(),
        time: known.time,
        state: known.state,
    };
    let difference = reference.difference(run).and_then(agreement);
    Ok(Reference {
        difference: difference.map_err(|reason| refusal(checked_by, reason))?,
        ..reference
    })
}

/// The tightest run, with the check that agrees best.
fn from_runs<S: System<Scalar = f64>>(
    course: &Course<S>,
    by: Setting,
    tightest: Finish,
) -> Result<Reference, Refusal> {
    let reference = Reference {
        by: by.to_string(),
        checked_by: String::new(),
        difference: f64::INFINITY,
        floor: f64::INFINITY,
        events: tightest.events,
        time: tightest.time,
        state: tightest.state,
    };
    let mut refused = None;
    for group in CHECKS {
        let mut best: Option<(Setting, f64)> = None;
        for &setting in group {
            let run = course.run(setting).map_err(|error| error.to_string());
            let difference = run.and_then(|run| reference.difference(&finish(&run)));
            match difference.and_then(agreement) {
                Ok(difference) if best.is_none_or(|(_, least)| difference < least) => {
                    best = Some((setting, difference));
                }
                Ok(_) => {}
                Err(reason) => refused = refused.or(Some(refusal(setting, reason))),
            }
        }
        if let Some((setting, difference)) = best {
            return Ok(Reference {
                checked_by: setting.to_string(),
                difference,
                floor: difference.max(f64::EPSILON),
                ..reference
            });
        }
    }
    Err(refused.unwrap_or_else(|| refusal(by, "nothing to check it by".to_owned())))
}

#[cfg(test)]
mod tests {
    use super::list;

    #[test]
    fn events_in_a_row_are_counted() {
        let labels = ["a hit", "a hit", "b lost", "a hit"].map(str::to_owned);
        assert_eq!(list(&labels), "a hit ×2, b lost, a hit");
        assert_eq!(list(&[]), "nothing");
    }
}
