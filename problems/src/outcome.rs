//! A run as plain data: what every printer starts from, whatever the type of the scene was.

use core::iter;
use lagrange_core::dynamics::{Dynamics, NeedSet};
use lagrange_core::mode::{FrictionMode, Mode};
use lagrange_core::prelude::*;
use lagrange_core::system::{Description, Friction, Normal};

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
    /// Event log.
    pub events: Vec<Event<f64>>,
    /// Modes in order of time.
    pub phases: Vec<Phase>,
    /// The trajectory at some instants, and at the beginning and the end of every phase; in order of time.
    /// Empty if the run could not begin.
    pub samples: Vec<Sample>,
    /// Energy book; `None` if it could not be drawn up.
    pub ledger: Option<Ledger>,
    /// The same from the beginning to each sample, if that was asked for and can be drawn up; at the instant of an impact with
    /// the impact.
    pub ledgers: Vec<Ledger>,
    /// Work counts.
    pub work: Work,
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
    /// Per row: whether the motion leaves its force open, so that a share of least norm is given; empty where none is.
    pub undetermined: Vec<bool>,
    /// What each friction can hold: μₛN while it sticks, μₖN while it slips, `None` while it is inactive.
    pub limits: Vec<Option<f64>>,
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Potential energy, J.
    pub potential: f64,
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

/// The forces of a scene, in order of declaration: constraints, contacts, frictions.
pub fn forces(description: &Description) -> Vec<Force> {
    let constraints = description
        .constraints
        .iter()
        .enumerate()
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

impl Outcome {
    /// Collects what a trajectory knows; these times, in order, are sampled beside the ends of the phases.
    pub(crate) fn new(
        scene: &'static str,
        trajectory: &Record<f64>,
        failure: Option<Error>,
        times: &[f64],
        ledgers: bool,
    ) -> Self {
        let description = trajectory.description();
        let samples = sample(trajectory, times);
        let times: Vec<f64> = samples.iter().map(|sample| sample.time).collect();
        let ledgers = ledgers.then(|| trajectory.ledgers(&times).ok()).flatten();
        Outcome {
            scene,
            description,
            parameters: (0..description.parameters.len())
                .map(|i| trajectory.parameter(i))
                .collect(),
            effects: trajectory.effects().clone(),
            events: trajectory.events().to_vec(),
            phases: trajectory.phases(),
            samples,
            ledger: trajectory.ledger().ok(),
            ledgers: ledgers.unwrap_or_default(),
            work: trajectory.work(),
            failure,
        }
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
                || events
                    .clone()
                    .any(|e| is(&e.undetermined) || is(&e.undetermined_after))
        };
        let all = forces(self.description).into_iter();
        all.filter(|force| open(force.row))
            .map(|force| force.name)
            .collect()
    }

    /// The first instant, if the run began.
    pub fn first(&self) -> Option<&Sample> {
        self.samples.first()
    }

    /// The last instant, if the run began.
    pub fn last(&self) -> Option<&Sample> {
        self.samples.last()
    }
}

/// The instants between so many equal intervals of a motion.
pub(crate) fn equal(trajectory: &Record<f64>, intervals: usize) -> Vec<f64> {
    let (first, last) = (trajectory.first_time(), trajectory.last_time());
    let step = (last - first) / intervals.max(1) as f64;
    (1..intervals).map(|k| first + k as f64 * step).collect()
}

/// Both ends of every phase, and between them these times, which are in order.
fn sample(trajectory: &Record<f64>, times: &[f64]) -> Vec<Sample> {
    let (first, last) = (trajectory.first_time(), trajectory.last_time());
    let mut sampler = trajectory.sampler();
    let mut limits = Limits::new(trajectory.dynamics());
    let mut samples = Vec::new();
    let at_once = || {
        vec![Phase {
            from: first,
            to: first,
            mode: trajectory.final_mode().clone(),
        }]
    };
    let phases = Some(trajectory.phases())
        .filter(|phases| !phases.is_empty())
        .unwrap_or_else(at_once);
    for (phase, span) in phases.iter().enumerate() {
        let after = times.partition_point(|t| *t <= span.from);
        let before = times.partition_point(|t| *t < span.to).max(after);
        let inner = times[after..before].iter().copied();
        limits.enter(&span.mode);
        for time in iter::once(span.from)
            .chain(inner)
            .chain(iter::once(span.to))
        {
            // At a switch a sampler gives what is just after it: the end of a phase is read a trifle before.
            let read = if time == span.to && time < last {
                just_before(time)
            } else {
                time
            };
            let Ok(instant) = sampler.at(read) else {
                continue;
            };
            if instant.mode != span.mode {
                continue;
            }
            samples.push(Sample {
                time,
                phase,
                limits: limits.at(time, &instant),
                mode: instant.mode,
                state: State {
                    q: instant.q,
                    v: instant.v,
                },
                forces: instant.forces,
                undetermined: instant.undetermined,
                kinetic: instant.kinetic,
                potential: instant.potential,
                observes: instant.observes,
            });
        }
    }
    if let Some(end) = samples.last_mut().filter(|end| end.time == last) {
        end.state = trajectory.final_state().clone();
    }
    samples
}

fn just_before(time: f64) -> f64 {
    time - 4.0 * f64::EPSILON * time.abs().max(1.0)
}

/// What frictions can hold: coefficient × normal force.
struct Limits {
    dynamics: Dynamics<f64>,
}

impl Limits {
    fn new(mut dynamics: Dynamics<f64>) -> Self {
        let description = dynamics.description();
        let mut needs = NeedSet::new(description);
        for friction in description.frictions {
            needs.insert(friction.coefficients_need);
        }
        dynamics.set_extra_needs(&needs);
        Self { dynamics }
    }

    fn enter(&mut self, mode: &Mode) {
        self.dynamics.set_mode(mode);
    }

    fn at(&mut self, time: f64, instant: &Instant<f64>) -> Vec<Option<f64>> {
        let description = self.dynamics.description();
        let along = self.dynamics.value_along(time, &instant.q, &instant.v);
        if along.is_err() {
            return vec![None; description.frictions.len()];
        }
        let dynamics = &self.dynamics;
        let limit = |(friction, mode): (&Friction, &FrictionMode)| {
            let coefficient = match mode {
                FrictionMode::Inactive => return None,
                FrictionMode::Stick => friction.static_coefficient,
                FrictionMode::Slip(_) => friction.kinetic_coefficient,
            };
            let normal = match friction.normal {
                Normal::Contact(i) => {
                    let contact = &description.contacts[i];
                    let factor = contact
                        .normal_factor
                        .map_or(1.0, |place| dynamics.motion(place));
                    factor * instant.forces[contact.row]
                }
                Normal::Constraint(i) => instant.forces[description.constraints[i].row].abs(),
                Normal::Given(place) => dynamics.motion(place),
            };
            Some(dynamics.motion(coefficient) * normal)
        };
        description
            .frictions
            .iter()
            .zip(&dynamics.mode().frictions)
            .map(limit)
            .collect()
    }
}
