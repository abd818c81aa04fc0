//! What accuracy costs: methods × tolerances, measured in one process against a reference.
//!
//! ```text
//! Study → reference → settings → rows (error, drift, work) → rows with times → Accuracy
//! ```
//!
//! An error is the largest |found − reference| / max(1, |reference|) of what it is about: the final state, or the times
//! of the events. All settings are timed in turn, again and again, so that whatever else the machine does falls on all.

mod family;
mod motion;
mod reference;
mod timing;

pub use family::{Family, ParseFamilyError, Setting, family};
pub use reference::Reference;
pub use timing::Timing;

use motion::Motion;
use timing::Timed;

use crate::closed_form::ClosedForm;
use crate::request::{Refusal, Request};
use crate::scene::{Beginning, Scene};
use lagrange_core::prelude::*;
use lagrange_core::system::Description;
use lagrange_core::trajectory::{Difference, Summary};

/// What is to be measured.
#[derive(Clone, Debug)]
pub struct Study {
    /// Parameters, start and end of the runs.
    pub request: Request,
    /// Methods.
    pub methods: Vec<Family>,
    /// Tolerances.
    pub tolerances: Vec<f64>,
    /// How often each setting is timed; if `None`, often enough, and less often what takes long.
    pub repeat: Option<usize>,
}

/// What accuracy costs in a scene.
#[derive(Clone, Debug)]
pub struct Accuracy {
    /// Name of the scene.
    pub scene: &'static str,
    /// Its names.
    pub description: &'static Description,
    /// Value of every parameter.
    pub parameters: Vec<f64>,
    /// What errors are measured against.
    pub reference: Reference,
    /// One row per method and tolerance, in the order of the study.
    pub rows: Vec<Row>,
}

/// One method at one tolerance.
#[derive(Clone, Debug)]
pub struct Row {
    /// Method and tolerance.
    pub setting: Setting,
    /// What it achieved and cost, or why there is nothing to compare.
    pub result: Result<Measured, String>,
}

/// What a setting achieves and costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Error of the final state.
    pub state_error: f64,
    /// Largest error of an event's time; `None` if nothing happens.
    pub event_error: Option<f64>,
    /// What the energy book does not explain, over the scale of the energies; `None` if it could not be drawn up.
    pub energy_drift: Option<f64>,
    /// Largest residual of what has to hold (constraints, closed contacts, slips that stick), on position and velocity
    /// level, at the events and at the end, relative to the state; `None` if nothing has to hold there.
    pub constraint_drift: Option<f64>,
    /// Work counts.
    pub work: Work,
    /// Time of a run.
    pub time: Timing,
}

impl Measured {
    /// The larger of the errors.
    pub fn error(&self) -> f64 {
        self.state_error.max(self.event_error.unwrap_or(0.0))
    }
}

/// The first round in units of the others: it judges a run, and what takes long sits out the others.
const FIRST: usize = 30;

impl dyn Scene + '_ {
    /// Measures what accuracy costs.
    ///
    /// # Errors
    /// The request makes no sense, the start does not exist, or there is nothing to measure errors against.
    pub fn accuracy(&self, study: &Study) -> Result<Accuracy, Refusal> {
        let request = &study.request;
        let Beginning {
            system,
            start,
            until,
        } = self.beginning(request)?;
        let simulation = request.simulation(&system)?;
        let effects = request.effects(system.description())?;
        // A closed form is that of the whole declaration.
        let whole = effects.left_out().next().is_none();
        let closed_form = match whole {
            true => self.closed_form(&system, &start, until),
            false => None,
        };
        let motion = Motion {
            system: &system,
            simulation,
            start,
            until,
            max_steps: 400_000,
        };
        let accuracy = measure(self.name(), &motion, study, closed_form);
        accuracy.map_err(|refusal| refusal.or_of_start(&motion.simulation, &motion.start))
    }
}

/// Measures `study` on a scene. What fails half-way is a row that says why. If the progress of its request is stopped, there
/// are the rows until then.
///
/// # Errors
/// Nothing to measure against: no run gets to the end, or two do not agree about what happens.
fn measure(
    scene: &'static str,
    motion: &Motion<'_>,
    study: &Study,
    closed_form: Option<ClosedForm>,
) -> Result<Accuracy, Refusal> {
    let (reference, scale) = reference::reference(motion, closed_form)?;
    let settings = family::settings(&study.methods, &study.tolerances, scale);
    let progress = study.request.progress.clone().unwrap_or_default();
    let rounds = timing::rounds(study.repeat);
    progress.expect(settings.len() * (FIRST + rounds - 1));
    let mut rows = Vec::new();
    for setting in settings {
        let result = judge(motion, setting, &reference);
        let mut row = Timed::new(Row { setting, result }, motion.clock(setting));
        row.round();
        if progress.is_stopped() {
            break;
        }
        rows.push(row);
        progress.advance(FIRST);
    }
    timing::rest(&mut rows, study.repeat, &progress);
    Ok(Accuracy {
        scene,
        description: motion.system.description(),
        parameters: motion.parameters(),
        reference,
        rows: rows.into_iter().map(Timed::done).collect(),
    })
}

/// Everything about a setting but its time.
fn judge(motion: &Motion<'_>, setting: Setting, reference: &Reference) -> Result<Measured, String> {
    let trajectory = motion.run(setting)?;
    let Difference {
        state_error,
        event_error,
        ..
    } = reference.errors(&Summary::of(&trajectory))?;
    Ok(Measured {
        state_error,
        event_error,
        energy_drift: motion::energy_drift(&trajectory),
        constraint_drift: motion::constraint_drift(&trajectory),
        work: trajectory.work(),
        time: Timing::default(),
    })
}

impl Accuracy {
    /// The error of a row as far as it can be told: not below the floor of the reference.
    pub fn resolved(&self, measured: &Measured) -> f64 {
        measured.error().max(self.reference.floor)
    }

    /// Time of a row over that of the fastest one that is at least as exact.
    pub fn ratio(&self, measured: &Measured) -> f64 {
        let as_exact = self.fastest(self.resolved(measured));
        as_exact.map_or(1.0, |(_, best)| measured.time.best / best.time.best)
    }

    /// The fastest setting with an error of at most `target`.
    pub fn fastest(&self, target: f64) -> Option<(Setting, &Measured)> {
        self.reaching(target)
            .min_by(|(_, a), (_, b)| a.time.best.total_cmp(&b.time.best))
    }

    /// The fastest setting of each method with an error of at most `target`, fastest first.
    pub fn fastest_of_each(&self, target: f64) -> Vec<(Setting, &Measured)> {
        let mut all: Vec<_> = self.reaching(target).collect();
        all.sort_by(|(_, a), (_, b)| a.time.best.total_cmp(&b.time.best));
        let mut fastest: Vec<(Setting, &Measured)> = Vec::new();
        for (setting, measured) in all {
            if fastest
                .iter()
                .all(|(known, _)| known.name() != setting.name())
            {
                fastest.push((setting, measured));
            }
        }
        fastest
    }

    /// The setting with the smallest error, as far as it can be told; the fastest of several.
    pub fn most_exact(&self) -> Option<(Setting, &Measured)> {
        let least = self
            .reaching(f64::INFINITY)
            .map(|(_, measured)| self.resolved(measured))
            .min_by(f64::total_cmp)?;
        self.fastest(least)
    }

    fn reaching(&self, target: f64) -> impl Iterator<Item = (Setting, &Measured)> {
        self.rows.iter().filter_map(move |row| {
            let measured = row.result.as_ref().ok()?;
            (self.resolved(measured) <= target).then_some((row.setting, measured))
        })
    }
}
