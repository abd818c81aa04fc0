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

/// The tightest run, the first of these that gets to the end: Taylor series; where they would need too many steps because the motion is
/// stiff, with Radau's method in their place there.
const TIGHTEST: [Setting; 4] = [taylor(1e-16), auto(1e-15), auto(1e-14), auto(1e-13)];

/// Groups of runs that check it; of the first group with one that gets to the end, the one that agrees best. Other
/// methods, as tight as they can be, Radau's where the motion is stiff; where none gets there, the same one with series of another
/// order, and it is said.
const CHECKS: [&[Setting]; 7] = [
    &explicit(1e-15),
    &[radau5(1e-13)],
    &[radau5(1e-11)],
    &explicit(1e-13),
    &explicit(1e-11),
    &explicit(1e-9),
    &[taylor(1e-12)],
];

const fn setting(method: Method, tolerance: f64) -> Setting {
    Setting { method, tolerance }
}

const fn taylor(tolerance: f64) -> Setting {
    setting(Method::Taylor, tolerance)
}

const fn auto(tolerance: f64) -> Setting {
    setting(Method::Auto, tolerance)
}

const fn radau5(tolerance: f64) -> Setting {
    setting(Method::Radau5, tolerance)
}

const fn explicit(tolerance: f64) -> [Setting; 2] {
    [
        setting(Method::Verner98, tolerance),
        setting(Method::DormandPrince853, tolerance),
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
            let stiff = !tightest.stiff().is_empty();
            // A check that gets stuck in ever smaller steps is of no use, and takes long; what is stiff takes them.
            let patient = Motion {
                start: motion.start.clone(),
                simulation: motion.simulation.clone(),
                max_steps: match stiff {
                    true => motion.max_steps,
                    false => (10_000 + 100 * steps).min(motion.max_steps),
                },
                ..*motion
            };
            from_runs(&patient, setting, summary, stiff)
        }
    };
    Ok((reference?, scale))
}

fn tightest(motion: &Motion<'_>) -> Result<(Setting, Trajectory), Refusal> {
    let mut refused = None;
    for setting in TIGHTEST {
        match motion.run(setting) {
            Ok(run) => return Ok((setting, run)),
            Err(reason) => refused = refused.or(Some(refusal(setting, reason))),
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
fn from_runs(
    motion: &Motion<'_>,
    by: Setting,
    tightest: Summary,
    stiff: bool,
) -> Result<Reference, Refusal> {
    let reference = Reference {
        by: by.to_string(),
        checked_by: String::new(),
        difference: f64::INFINITY,
        floor: f64::INFINITY,
        truth: tightest,
    };
    let mut refused = None;
    let suits = |group: &&[Setting]| stiff || group[0].method != Method::Radau5;
    for group in CHECKS.into_iter().filter(suits) {
        let mut best: Option<(Setting, f64)> = None;
        for &setting in group {
            let agreement = |run: Trajectory| {
                let found = reference.agreement(&Summary::of(&run));
                found.map_err(|reason| {
                    format!("{reason}; end earlier, with --until, where runs still agree")
                })
            };
            match motion.run(setting).and_then(agreement) {
                Ok(difference) if best.is_none_or(|(_, least)| difference < least) => {
                    best = Some((setting, difference));
                }
                Ok(_) => {}
                Err(reason) => refused = refused.or(Some(refusal(setting, reason))),
            }
        }
        if let Some((setting, difference)) = best {
            return Ok(Reference {
                checked_by: match (by.method, setting.method) {
                    (Method::Auto, Method::Radau5) => {
                        format!("{setting} (the same method where it is stiff)")
                    }
                    (Method::Auto | Method::Taylor, Method::Taylor) => {
                        format!("{setting} (the same method)")
                    }
                    _ => setting.to_string(),
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

    /// A body creeps in oil, x = e^(-rate t): every explicit step is as short as 1/c, and too many would be needed.
    #[test]
    fn what_is_stiff_has_a_reference() {
        let declared = "parameters(c = 1e5, k = 3e4, rate = 0.30000090000540004), coordinates(x), kinetic = der(x)^2/2,
            potential = k/2*x^2, dissipation(oil: c/2*der(x)^2), start(creeping: x = 1, der(x) = -rate), until = 10,";
        let scene = crate::file::scene("oil.lagrange", declared).expect("a declaration");
        let begun = scene.beginning(&Request::default()).expect("a beginning");
        let simulation = Request::default()
            .simulation(&begun.system)
            .expect("a simulation");
        let motion = |max_steps| Motion {
            system: &begun.system,
            start: begun.start.clone(),
            simulation: simulation.clone(),
            until: begun.until,
            max_steps,
        };
        let (found, _) = reference(&motion(50_000), None).expect("a reference");
        assert_eq!(found.by, "auto at 1e-15");
        let checked_by = "radau5 at 1e-13 (the same method where it is stiff)";
        assert_eq!(found.checked_by, checked_by);
        let exact = (-0.300_000_900_005_400_04_f64 * 10.0).exp();
        let error = (found.truth.state.q[0] - exact).abs();
        assert!(
            error <= 1e-14 && found.floor <= 1e-13,
            "{error:e} {:e}",
            found.floor
        );
        // The limit is none that a user of the program could raise.
        let refused = reference(&motion(1000), None)
            .map(|_| ())
            .expect_err("a limit");
        let told = refused.to_string();
        assert!(
            told.contains("more than 1000 steps; end earlier, with --until"),
            "{told}"
        );
    }

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
            let reference = from_runs(&motion, setting, Summary::of(&run), false);
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
