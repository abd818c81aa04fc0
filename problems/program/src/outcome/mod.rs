//! A run as plain data: what every printer starts from, whatever the type of the scene was.

mod join;
pub(crate) mod pieces;
pub(crate) mod rounding;
mod sampling;

use crate::number::significant;
use crate::request::Request;
use crate::request::event::events;
use core::ops::Range;
use lagrange_core::__private::places::Normal;
use lagrange_core::certificate::Certificate;
use lagrange_core::error::Shortest;
use lagrange_core::mode::{FrictionMode, Mode};
use lagrange_core::prelude::*;
use lagrange_core::simulation::Awaited;
use lagrange_core::system::Description;
pub(crate) use sampling::{book_times, equal, within};

/// Everything that happened in a run.
pub struct Outcome {
    /// Name of the scene.
    pub scene: &'static str,
    /// Its names.
    pub description: &'static Description,
    /// Value of every parameter.
    pub parameters: Vec<f64>,
    /// What takes part.
    pub effects: Effects,
    /// Method of integration.
    pub method: Method,
    /// Its tolerance, relative and absolute.
    pub tolerance: f64,
    /// Absolute tolerances of coordinates that have one of their own, by name.
    pub absolute: Vec<(String, f64)>,
    /// Events that it was to end after, as they were asked for.
    pub end_after: Vec<String>,
    /// How far off it is, if that was asked for.
    pub estimate: Option<Estimate>,
    /// Where it was to start, if what holds there may have moved the start.
    pub asked: Option<State<f64>>,
    /// Event log.
    pub events: Vec<Event<f64>>,
    /// Modes in order of time.
    pub phases: Vec<Phase>,
    /// The trajectory at some instants, and at the beginning and the end of every phase; in order of time.
    /// Empty if the run could not begin.
    pub samples: Vec<Sample>,
    /// The same for curves: denser where the motion is too fast for the samples; empty if nothing is to be plotted.
    pub curve: Vec<Sample>,
    /// The energy book from the beginning to each of those, if that was asked for and can be drawn up.
    pub(crate) curve_ledgers: Vec<Ledger>,
    /// What is known beside the log just before and just after each event, if the run was sampled between its ends; nothing
    /// between events at one instant.
    pub around: Vec<[Option<Sample>; 2]>,
    /// The run checked against its declaration; `None` if the motion could not be evaluated everywhere, or if there is none.
    pub certificate: Option<Certificate>,
    /// Energy book; `None` if it could not be drawn up.
    pub ledger: Option<Ledger>,
    /// The same from the beginning to each sample, if that was asked for and can be drawn up; at the instant of an impact with
    /// the impact.
    pub ledgers: Vec<Ledger>,
    /// The same at each event.
    pub event_ledgers: Vec<Ledger>,
    /// Work counts.
    pub work: Work,
    /// When steps were bounded by stability ([`Trajectory::stiff`]).
    pub stiff: Vec<Range<f64>>,
    /// Why the run ended early.
    pub failure: Option<Error>,
}

/// The motion at one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Time, s.
    pub time: f64,
    /// Index of the phase it belongs to.
    pub phase: usize,
    /// Mode.
    pub mode: Mode,
    /// Positions and velocities.
    pub state: State<f64>,
    /// λ of every row; for a friction its force along +slip.
    pub forces: Vec<f64>,
    /// Per row: the size of what its force holds in balance.
    pub held: Vec<f64>,
    /// Per row: whether the motion does not determine its force, so that the one of least norm is given; empty where all are determined.
    pub undetermined: Vec<bool>,
    /// What each friction can hold: μₛN while it sticks, μₖN while it slips, `None` while it is inactive.
    pub limits: Vec<Option<f64>>,
    /// Kinetic and potential energy and the Jacobi integral, J.
    pub energies: Energies,
    /// Extra outputs.
    pub observes: Vec<f64>,
}

/// A force that a run reports: a named item and the row of its multiplier.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Force {
    /// Name of the item; with the component for a slip in space.
    pub name: String,
    /// Row.
    pub row: usize,
    /// What it is.
    pub source: Source,
}

/// Where a force comes from: index into the description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// Of this constraint.
    Constraint(usize),
    /// Of this contact: its normal force.
    Contact(usize),
    /// Of this friction.
    Friction(usize),
}

impl Force {
    /// The contact without which it does not act, if there is one.
    pub fn contact(&self, description: &Description) -> Option<usize> {
        match self.source {
            Source::Constraint(i) => description.constraints[i].while_contact,
            Source::Contact(i) => Some(i),
            Source::Friction(i) => match description.frictions[i].normal {
                Normal::Contact(contact) => Some(contact),
                _ => None,
            },
        }
    }

    /// Whether it acts in `mode`.
    pub fn acts(&self, description: &Description, mode: &Mode) -> bool {
        match self.source {
            Source::Constraint(i) => description.constraints[i]
                .while_contact
                .is_none_or(|c| mode.contacts[c]),
            Source::Contact(i) => mode.contacts[i],
            Source::Friction(i) => mode.frictions[i] != FrictionMode::Inactive,
        }
    }
}

/// The forces of a scene, in order of declaration: constraints, contacts, frictions. What keeps the quaternion of an attitude at
/// unit length is no force.
pub fn forces(description: &Description) -> Vec<Force> {
    let constraints = description
        .constraints
        .iter()
        .enumerate()
        .filter(|(_, constraint)| constraint.attitude.is_none())
        .map(|(i, constraint)| Force {
            name: constraint.name.to_owned(),
            row: constraint.row,
            source: Source::Constraint(i),
        });
    let contacts = description
        .contacts
        .iter()
        .enumerate()
        .map(|(i, contact)| Force {
            name: contact.name.to_owned(),
            row: contact.row,
            source: Source::Contact(i),
        });
    let frictions = description
        .frictions
        .iter()
        .enumerate()
        .flat_map(|(i, friction)| {
            (0..friction.components).map(move |k| Force {
                name: match friction.components {
                    1 => friction.name.to_owned(),
                    _ => format!("{}[{k}]", friction.name),
                },
                row: friction.row + k,
                source: Source::Friction(i),
            })
        });
    constraints.chain(contacts).chain(frictions).collect()
}

/// Absolute tolerances of coordinates that have one of their own.
fn own_tolerances(trajectory: &Trajectory) -> Vec<(String, f64)> {
    let coordinates = trajectory.description().coordinates.iter().enumerate();
    coordinates
        .map(|(i, c)| {
            (
                c.name.to_owned(),
                trajectory.absolute_tolerance(CoordinateId(i)),
            )
        })
        .filter(|(_, absolute)| *absolute != trajectory.tolerance())
        .collect()
}

impl Outcome {
    /// Whether anything moved or happened before the run failed.
    pub fn has_begun(&self) -> bool {
        self.failure.is_none() || self.work.steps > 0 || !self.events.is_empty()
    }

    /// Collects what a trajectory knows, sampled at equal intervals as the request says.
    pub(crate) fn new(
        scene: &'static str,
        trajectory: &Trajectory,
        failure: Option<Error>,
        request: &Request,
    ) -> Self {
        let times = equal(trajectory, request.samples);
        Self::sampled(scene, trajectory, failure, request, &times)
    }

    /// The same, sampled at these times, which are in order.
    pub(crate) fn sampled(
        scene: &'static str,
        trajectory: &Trajectory,
        failure: Option<Error>,
        request: &Request,
        times: &[f64],
    ) -> Self {
        let description = trajectory.description();
        let samples = sampling::samples(trajectory, times);
        let curve = match request.plotted {
            true => {
                // A piece of a run has its share of the intervals.
                let share = (times.len() + 1) as f64 / request.samples.max(1) as f64;
                sampling::curve(trajectory, times, &samples, share.min(1.0))
            }
            false => Vec::new(),
        };
        let moved = trajectory.work().steps > 0 || failure.is_none();
        let events = trajectory.events();
        let ledgers = |times: Vec<f64>| match request.ledger {
            true => trajectory.ledgers(&times).unwrap_or_default(),
            false => Vec::new(),
        };
        let mut outcome = Outcome {
            scene,
            description,
            parameters: (0..description.parameters.len())
                .map(|i| trajectory.parameter(i))
                .collect(),
            method: trajectory.method(),
            tolerance: trajectory.tolerance(),
            absolute: own_tolerances(trajectory),
            end_after: request.end_after.clone(),
            estimate: trajectory.estimate().cloned(),
            effects: trajectory.effects().clone(),
            asked: None,
            events: events.to_vec(),
            phases: trajectory.phases(),
            around: match request.samples {
                0 if trajectory.description().observes.is_empty() => Vec::new(),
                _ => sampling::around(trajectory),
            },
            certificate: moved
                .then(|| {
                    trajectory
                        .verify_share(request.seed, request.certified)
                        .ok()
                })
                .flatten(),
            ledger: request.stage(trajectory.last_time(), || {
                moved.then(|| trajectory.ledger().ok()).flatten()
            }),
            ledgers: ledgers(book_times(&samples)),
            event_ledgers: ledgers(events.iter().map(|event| event.time).collect()),
            samples,
            curve,
            curve_ledgers: Vec::new(),
            work: trajectory.work(),
            stiff: trajectory.stiff().to_vec(),
            failure,
        };
        outcome.take_out_rounding();
        outcome
    }

    /// Whether what a force is of takes part.
    pub fn includes(&self, source: Source) -> bool {
        let item = match source {
            Source::Constraint(i) => Item::Constraint(i),
            Source::Contact(i) => Item::Contact(i),
            Source::Friction(i) => Item::Friction(i),
        };
        self.effects.includes(self.description, item)
    }

    /// Names of what was left out.
    pub fn left_out(&self) -> Vec<&'static str> {
        let items = self.effects.left_out();
        items.map(|item| item.name(self.description)).collect()
    }

    /// Names of the forces that the motion leaves open at some sample or event, in order of declaration.
    pub fn undetermined(&self) -> Vec<String> {
        let open = |row: usize| {
            let is = |flags: &Vec<bool>| flags.get(row) == Some(&true);
            let events = self.events.iter();
            self.samples.iter().any(|s| is(&s.undetermined))
                || events.clone().any(|e| {
                    // What was tried first at the start never acted.
                    let before = is(&e.undetermined) && !self.is_decided_at_start(e);
                    before || is(&e.undetermined_after)
                })
        };
        let all = forces(self.description).into_iter();
        all.filter(|force| open(force.row))
            .map(|force| force.name)
            .collect()
    }

    /// Whether a friction slides somewhere whose force the motion leaves open: how such forces are shared out may then move something.
    pub fn slides_undetermined(&self) -> bool {
        let slides = |mode: &Mode, open: &[bool]| {
            let frictions = self.description.frictions.iter().zip(&mode.frictions);
            let mut sliding = frictions.filter(|(_, state)| matches!(state, FrictionMode::Slip(_)));
            sliding.any(|(friction, _)| open.get(friction.row) == Some(&true))
        };
        let mut samples = self.samples.iter();
        samples.any(|s| slides(&s.mode, &s.undetermined))
            || self.events.iter().any(|e| {
                let before = slides(&e.before, &e.undetermined) && !self.is_decided_at_start(e);
                before || slides(&e.after, &e.undetermined_after)
            })
    }

    /// The outputs that are no finite numbers at some sample, and the time of the first of these, s.
    pub fn without_value(&self) -> Vec<(&'static str, f64)> {
        let outputs = self.description.observes.iter().enumerate();
        let found = outputs.filter_map(|(i, output)| {
            let first = self.samples.iter().find(|s| !s.observes[i].is_finite())?;
            Some((output.name, first.time))
        });
        found.collect()
    }

    /// What the run was to end after and what has not happened in all of its time, in words.
    pub fn never_came(&self) -> Option<String> {
        let is_missing = |name: &&String| {
            let came = |awaited: Awaited| {
                let events = self.events.iter();
                events.filter(|event| awaited.is(event)).count() >= awaited.number
            };
            let all = events(name, self.description);
            all.is_ok_and(|all| !all.into_iter().map(Awaited::from).all(came))
        };
        let missing = self.end_after.iter().filter(is_missing);
        let missing: Vec<String> = missing.map(|name| format!("`{name}`")).collect();
        let told = || {
            format!(
                "What the run was to end after has not happened: {}.",
                missing.join(", ")
            )
        };
        (self.failure.is_none() && !missing.is_empty()).then(told)
    }

    /// When steps were bounded by stability, and what that means, if they were.
    pub fn stiffness(&self) -> Option<String> {
        let (first, last) = (self.stiff.first()?, self.stiff.last()?);
        let told = |time: f64| Shortest(significant(time));
        let when = match self.stiff.len() {
            1 => format!("From t = {} s", told(first.start)),
            many => format!("{many} times from t = {} s", told(first.start)),
        };
        let what = match self.method {
            Method::Auto => "Radau has made the steps",
            _ => "the methods auto and radau5 make far longer ones",
        };
        Some(format!(
            "{when} to {} s steps were bounded by stability, not by accuracy (the system is stiff there): {what}.",
            told(last.end)
        ))
    }

    /// The first instant, if the run began.
    pub fn first(&self) -> Option<&Sample> {
        self.samples.first()
    }

    /// Whether an event is what was decided at the start, which is no motion yet: the mode that was tried first never acted.
    pub fn is_decided_at_start(&self, event: &Event<f64>) -> bool {
        let start = self.first().map(|sample| sample.time);
        Some(event.time) == start && event.before != event.after
    }

    /// The last instant, if the run began.
    pub fn last(&self) -> Option<&Sample> {
        self.samples.last()
    }

    /// How long the run is, s.
    pub fn lasts(&self) -> f64 {
        match (self.first(), self.last()) {
            (Some(first), Some(last)) => last.time - first.time,
            _ => 0.0,
        }
    }
}
