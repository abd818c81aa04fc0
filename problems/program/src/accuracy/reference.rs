//! What errors are measured against: a closed form, or the tightest run there is, checked by another method.
//!
//! Two references that have nothing in common but the scene differ by the errors of both. Below that difference, the
//! floor, no error of a run can be told.

use super::Setting;
use super::motion::Motion;
use crate::closed_form::ClosedForm;
use crate::request::Refusal;
use crate::request::event::event;
use lagrange_core::prelude::*;
use lagrange_core::system::Description;
use lagrange_core::trajectory::{Difference, Summary};

/// The tightest run: Taylor series, at the first of these tolerances that gets to the end.
const TIGHTEST: [Setting; 4] = [taylor(1e-16), taylor(1e-15), taylor(1e-14), taylor(1e-13)];

/// Groups of runs that check it; of the first group with one that gets to the end, the one that agrees best. Other
/// methods, as tight as they can be; where none gets there, the same one with series of another order, and it is said.
const CHECKS: [&[Setting]; 5] = [
    &explicit(1e-15),
    &explicit(1e-13),
    &explicit(1e-11),
    &explicit(1e-9),
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
#[derive(Clone, Debug)]
pub struct Reference {
    /// What it is: `taylor at 1e-16`, or the name of a closed form.
    pub by: String,
    /// What was compared with it.
    pub checked_by: String,
    /// Largest difference between the two.
    pub difference: f64,
    /// Below this an error cannot be told.
    pub floor: f64,
    /// Events and state at the end.
    pub truth: Summary,
}

impl Reference {
    /// How far a run is off, by its final state and the times of its events.
    ///
    /// # Errors
    /// Something else happened.
    pub(super) fn errors(&self, found: &Summary) -> Result<Difference, String> {
        let difference = found.compare(&self.truth);
        match &difference.parting {
            None => Ok(difference),
            Some(parting) => Err(format!(
                "other events: {} instead of {} at t = {}",
                parting.here, parting.there, parting.time
            )),
        }
    }

    /// The largest error, if it is one between two accounts of the same motion.
    fn agreement(&self, found: &Summary) -> Result<f64, String> {
        let difference = self.errors(found)?.error();
        match difference < SAME {
            true => Ok(difference),
            false => Err(format!("ends elsewhere, by {difference:.1e}")),
        }
    }
}

/// The reference of a run, and the time scale of its motion, s.
pub(super) fn reference(
    motion: &Motion<'_>,
    closed_form: Option<ClosedForm>,
) -> Result<(Reference, f64), Refusal> {
    let (setting, tightest) = tightest(motion)?;
    if tightest.last_time() == tightest.first_time() {
        let reason = "the run ends at the instant at which it begins".to_owned();
        return Err(refusal(setting, reason));
    }
    let steps = tightest.work().steps.max(1);
    let scale = RADIUS_PER_STEP * (tightest.last_time() - tightest.first_time()) / steps as f64;
    let summary = Summary::of(&tightest);
    let reference = match closed_form {
        Some(known) => from_closed_form(known, setting, &summary),
        None => {
            // A check that gets stuck in ever smaller steps is of no use, and takes long.
            let patient = Motion {
                start: motion.start.clone(),
                simulation: motion.simulation.clone(),
                max_steps: (10_000 + 100 * steps).min(motion.max_steps),
                ..*motion
            };
            from_runs(&patient, setting, summary)
        }
    };
    Ok((reference?, scale))
}

fn tightest(motion: &Motion<'_>) -> Result<(Setting, Trajectory), Refusal> {
    let mut refused = None;
    for setting in TIGHTEST {
        match motion.run(setting) {
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
    run: &Summary,
) -> Result<Reference, Refusal> {
    let reference = Reference {
        by: format!("the closed form ({})", known.by),
        checked_by: checked_by.to_string(),
        difference: 0.0,
        floor: known.rounding,
        truth: summary(known, run.description)?,
    };
    let difference = reference.agreement(run);
    Ok(Reference {
        difference: difference.map_err(|reason| refusal(checked_by, reason))?,
        ..reference
    })
}

fn summary(known: ClosedForm, description: &'static Description) -> Result<Summary, Refusal> {
    let happening = |(label, time): (&str, f64)| {
        event(label, description).map(|(subject, kind, _)| (subject, kind, time))
    };
    let events = known.events.into_iter().map(happening);
    Ok(Summary {
        description,
        events: events.collect::<Result<_, _>>()?,
        time: known.time,
        state: known.state,
        sizes: Vec::new(),
    })
}

/// The tightest run, with the check that agrees best.
fn from_runs(motion: &Motion<'_>, by: Setting, tightest: Summary) -> Result<Reference, Refusal> {
    let reference = Reference {
        by: by.to_string(),
        checked_by: String::new(),
        difference: f64::INFINITY,
        floor: f64::INFINITY,
        truth: tightest,
    };
    let mut refused = None;
    for group in CHECKS {
        let mut best: Option<(Setting, f64)> = None;
        for &setting in group {
            let run = motion.run(setting).map_err(|error| error.to_string());
            match run.and_then(|run| reference.agreement(&Summary::of(&run))) {
                Ok(difference) if best.is_none_or(|(_, least)| difference < least) => {
                    best = Some((setting, difference));
                }
                Ok(_) => {}
                Err(reason) => refused = refused.or(Some(refusal(setting, reason))),
            }
        }
        if let Some((setting, difference)) = best {
            return Ok(Reference {
                checked_by: match setting.method == by.method {
                    true => format!("{setting} (the same method)"),
                    false => setting.to_string(),
                },
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
    use super::*;
    use crate::request::Request;

    /// Fewer steps are allowed than tight runs of other methods need: a looser one of them checks, before the same method does.
    #[test]
    fn another_method_checks_while_one_gets_to_the_end() {
        let declared = "coordinates(x), kinetic = der(x)^2/2, potential = 1 - cos(x), start(out: x = 1), until = 200,";
        let scene = crate::file::scene("swing.lagrange", declared).expect("a declaration");
        let begun = scene.beginning(&Request::default()).expect("a beginning");
        let simulation = Request::default()
            .simulation(&begun.system)
            .expect("a simulation");
        let mut motion = Motion {
            system: &begun.system,
            start: begun.start.clone(),
            simulation,
            until: begun.until,
            max_steps: 100_000,
        };
        let steps =
            |motion: &Motion, setting: Setting| motion.run(setting).expect("a run").work().steps;
        let least = |motion: &Motion, tolerance: f64| {
            explicit(tolerance)
                .map(|setting| steps(motion, setting))
                .into_iter()
                .min()
        };
        let (tight, loose) = (least(&motion, 1e-11), least(&motion, 1e-9));
        let (tight, loose) = (tight.expect("two"), loose.expect("two"));
        let same = steps(&motion, taylor(1e-12));
        assert!(same < loose && loose < tight, "{same} {loose} {tight}");
        let mut checked = |max_steps| {
            motion.max_steps = max_steps;
            let (setting, run) = tightest(&motion).expect("a run");
            let reference = from_runs(&motion, setting, Summary::of(&run));
            reference.expect("a reference").checked_by
        };
        let by = checked((loose + tight) / 2);
        assert!(by.ends_with(" at 1e-9"), "{by}");
        assert_eq!(
            checked((same + loose) / 2),
            "taylor at 1e-12 (the same method)"
        );
    }
}
