//! What to run, as a user asks for it by name, and how the start is found from it.

pub(crate) mod event;

use crate::names::{is_element, nearest};
use crate::notation::velocity_name;
use crate::progress::Progress;
use core::fmt;
use core::ops::RangeInclusive;
use event::events;
use lagrange_core::effects::Item;
use lagrange_core::error::Shortest;
use lagrange_core::prelude::*;
use lagrange_core::system::{AnySystem, Description};
use std::collections::BTreeSet;

/// Most intervals that a run is sampled at: their numbers are kept in memory.
pub const MOST_SAMPLES: usize = 1_000_000;

/// Tolerances that an integration can have.
pub const TOLERANCES: RangeInclusive<f64> = 1e-17..=0.1;

/// Errors that can be asked for instead.
pub const ERRORS: RangeInclusive<f64> = 1e-15..=0.1;

/// A run of a scene as asked for. Names are those of the declaration.
#[derive(Clone, Debug)]
pub struct Request {
    /// Parameters that differ from the defaults.
    pub parameters: Vec<(String, f64)>,
    /// Named start; the first one if `None`.
    pub from: Option<String>,
    /// Items switched off (or on again), in this order.
    pub effects: Vec<(String, bool)>,
    /// Coordinates (`theta`) and velocities (`der(theta)`) to be held exactly.
    pub start: Vec<(String, f64)>,
    /// End, s; the scene's own if `None`.
    pub until: Option<f64>,
    /// Events (`rim lost`) after which the run ends, once each of them has happened; it goes on until its end if there are none.
    pub end_after: Vec<String>,
    /// Most events before the run ends with an error; 100 000 if `None`, and 10 000 in each run of a sweep.
    pub max_events: Option<usize>,
    /// Relative and absolute tolerance of the integration.
    pub tolerance: f64,
    /// Absolute tolerances of coordinates that have one of their own.
    pub absolute: Vec<(String, f64)>,
    /// Error that the final state and the times of events are to have at most, whatever the tolerance.
    pub error: Option<f64>,
    /// Whether a second run is to tell how far off the first is.
    pub estimate: bool,
    /// Method of integration.
    pub method: Method,
    /// Whether a start off a constraint is moved onto it.
    pub project: bool,
    /// How impacts at one instant are solved; as declared if `None`.
    pub impacts: Option<Impacts>,
    /// What evaluates the equations of motion.
    pub equations: Equations,
    /// Number of intervals to sample the trajectory at; 0 samples its ends only.
    pub samples: usize,
    /// Whether the motion is drawn as curves, for which fast motions are sampled more densely.
    pub plotted: bool,
    /// Whether the energy ledger is drawn up at every sample.
    pub ledger: bool,
    /// Seed of the instants at which the run is checked against its declaration.
    pub seed: u64,
    /// Share of the steps that are looked at for that; an eighth costs less than the run.
    pub certified: f64,
    /// Who watches the run, and may end it; nobody if `None`.
    pub progress: Option<Progress>,
}

impl Default for Request {
    fn default() -> Self {
        Self {
            parameters: Vec::new(),
            from: None,
            effects: Vec::new(),
            start: Vec::new(),
            until: None,
            end_after: Vec::new(),
            max_events: None,
            tolerance: 1e-9,
            absolute: Vec::new(),
            error: None,
            estimate: false,
            method: Method::Auto,
            project: false,
            impacts: None,
            equations: Equations::Emitted,
            samples: 0,
            plotted: false,
            ledger: false,
            seed: 0,
            certified: 0.125,
            progress: None,
        }
    }
}

/// Why a request cannot be run.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// A name that is not known.
    Unknown {
        /// What it should name.
        what: &'static str,
        /// As given.
        name: String,
        /// The nearest known name, if one is near.
        nearest: Option<String>,
        /// All known names.
        known: Vec<String>,
    },
    /// What is shown only as an output of the declaration.
    NoQuantity {
        /// As given.
        name: String,
    },
    /// A file that declares a system cannot be read, or has mistakes.
    Declaration {
        /// Which, where, and what to do.
        reason: String,
    },
    /// How a body is turned or spins, which only a start of the declaration says.
    OfBody {
        /// `top.turn`
        name: String,
        /// `q[0], q[1], q[2], q[3]`
        coordinates: String,
    },
    /// An attitude is to be switched.
    Attitude {
        /// Name of the body.
        body: String,
    },
    /// The same name twice.
    Repeated {
        /// The name.
        name: String,
    },
    /// What stands behind a kind of event is no number from 1.
    EventNumber {
        /// `rim lost 0`
        event: String,
        /// `rim lost 2`
        second: String,
    },
    /// An event of what is left out.
    LeftOut {
        /// `rim lost`, `t at rim lost`
        asked: String,
        /// `rim`
        item: &'static str,
    },
    /// A part is asked for of what is read from a whole run.
    Whole {
        /// `count grip slips 2`
        asked: String,
        /// `count grip slips`
        alone: String,
    },
    /// The impulse of something else than an impact.
    NoImpulse {
        /// `floor lost`
        event: String,
    },
    /// A force just before the contact closes on which it rests.
    NotYet {
        /// Of a contact, or of what acts while it is closed.
        force: String,
        /// The contact.
        contact: String,
        /// `floor impact`
        event: String,
        /// Whether it is an impact.
        has_impulse: bool,
    },
    /// An axis of a grid without the number of its values.
    Uncounted {
        /// The axis.
        axis: String,
    },
    /// No consistent state with the values that are to be held.
    Start(Error),
    /// The motion does not begin.
    Begin(Error),
    /// The run fails.
    Run(Error),
    /// A time after the end of the run.
    Ended {
        /// What was asked for, s.
        asked: f64,
        /// When the run ends, s.
        last: f64,
        /// What ends it, ` (floor stop)`; empty if nothing has happened.
        by: String,
    },
    /// More points than a sweep may have.
    TooMany {
        /// How many.
        points: f64,
        /// What their results would take.
        bytes: f64,
        /// How many there may be.
        most: usize,
    },
    /// No reference to measure errors against.
    Reference {
        /// The run that failed, or disagreed.
        by: String,
        /// Why, or how.
        reason: String,
    },
}

impl Refusal {
    /// Where no motion begins from a start, what a run says of that.
    pub(crate) fn or_of_start(
        self,
        simulation: &Simulation<'_, AnySystem<f64>>,
        start: &State<f64>,
    ) -> Self {
        match simulation.run(start.clone(), 0.0..0.0) {
            Err(failure) => Refusal::Begin(failure.error),
            Ok(_) => self,
        }
    }

    /// A refusal of `name`, with the nearest of the known names.
    pub fn unknown<'a>(
        what: &'static str,
        name: &str,
        known: impl Iterator<Item = &'a str>,
    ) -> Self {
        let known: Vec<&str> = known.collect();
        Refusal::Unknown {
            what,
            name: name.to_owned(),
            nearest: nearest(name, &known).map(str::to_owned),
            known: known.into_iter().map(str::to_owned).collect(),
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::Unknown {
                what,
                name,
                nearest,
                known,
            } => {
                write!(f, "no {what} is called `{name}`")?;
                match nearest {
                    Some(nearest) => write!(f, "; did you mean `{nearest}`?"),
                    None if known.is_empty() => write!(f, "; there are none"),
                    None if *what == "scene" => write!(f, "; `lagrange list` shows them"),
                    None => write!(f, "; there are: {}", known.join(", ")),
                }
            }
            Refusal::NoQuantity { name } => write!(
                f,
                "`{name}` is no quantity by itself; with `observe(u = {name})` in the declaration it is the output `u`"
            ),
            Refusal::Declaration { reason } => f.write_str(reason),
            Refusal::OfBody { name, coordinates } => write!(
                f,
                "`{name}` stands in a `start(…)` of the declaration, where a parameter can set it; here a body is turned by all of {coordinates}, \
                 which are cos(α/2) and sin(α/2) times the axis"
            ),
            Refusal::Attitude { body } => write!(
                f,
                "`{body}` is an attitude, which cannot be left out: without the unit length of its quaternion it is no orientation"
            ),
            Refusal::Repeated { name } => write!(f, "`{name}` is given twice; give it once"),
            Refusal::Uncounted { axis } => write!(
                f,
                "--vary {axis}: how many values? {axis}:50 takes 50, --sample sobol:50 points in the range"
            ),
            Refusal::TooMany {
                points,
                bytes,
                most,
            } => write!(
                f,
                "{points:e} points are too many: their results would take {bytes:.1e} bytes; a sweep has at most {most} points"
            ),
            Refusal::EventNumber { event, second } => write!(
                f,
                "events are counted from 1: `{second}` is the second, and there is no `{event}`"
            ),
            Refusal::LeftOut { asked, item } => {
                write!(f, "`{asked}`: `{item}` is left out, and its events with it")
            }
            Refusal::Whole { asked, alone } => write!(
                f,
                "`{alone}` is read from the whole run: leave out what follows it in `{asked}`; --end-after EVENT ends runs earlier"
            ),
            Refusal::NoImpulse { event } => write!(
                f,
                "`{event}` has no impulse: impacts have, as in `impulse floor at floor impact`"
            ),
            Refusal::NotYet {
                force,
                contact,
                event,
                has_impulse,
            } => {
                write!(
                    f,
                    "`{force} at {event}` is 0 in every run, since `{contact}` is open just before"
                )?;
                match has_impulse {
                    true => write!(f, "; `impulse {force} at {event}` is the impulse"),
                    false => Ok(()),
                }
            }
            Refusal::Ended { asked, last, by } => write!(
                f,
                "the run ends at t = {}{by}, before t = {}; ask for an earlier time",
                Shortest(*last),
                Shortest(*asked)
            ),
            Refusal::Begin(error) | Refusal::Run(error) => write!(f, "{error}"),
            Refusal::Start(error) => write!(f, "no such start: {error}"),
            Refusal::Reference { by, reason } => {
                write!(f, "no reference to measure errors against: {by}: {reason}")
            }
        }
    }
}

impl core::error::Error for Refusal {}

impl Request {
    /// Gives a system the parameters of the request; those that it does not name stay as they are.
    pub(crate) fn set_parameters(&self, system: &mut AnySystem<f64>) -> Result<(), Refusal> {
        for (index, (name, value)) in self.parameters.iter().enumerate() {
            if self.parameters[..index]
                .iter()
                .any(|(other, _)| other == name)
            {
                return Err(Refusal::Repeated { name: name.clone() });
            }
            for parameter in find_parameters(system.description(), name)? {
                system.set_parameter(parameter, *value);
            }
        }
        Ok(())
    }

    /// How to run `system`.
    pub(crate) fn simulation<'a>(
        &self,
        system: &'a AnySystem<f64>,
    ) -> Result<Simulation<'a, AnySystem<f64>>, Refusal> {
        let simulation = Simulation::new(system)
            .tolerance(self.tolerance)
            .method(self.method)
            .effects(self.effects(system.description())?)
            .project_start(self.project)
            .equations(self.equations);
        let mut simulation = match self.error {
            Some(error) => simulation.error(error),
            None => simulation.estimate(self.estimate),
        };
        for (name, tolerance) in &self.absolute {
            let coordinate = find_coordinate(system.description(), name)?;
            simulation = simulation.absolute_tolerance(coordinate, *tolerance);
        }
        let mut simulation = match self.impacts {
            Some(impacts) => simulation.impacts(impacts),
            None => simulation,
        };
        if let Some(limit) = self.max_events {
            simulation = simulation.max_events(limit);
        }
        for name in &self.end_after {
            for event in events(name, system.description())? {
                self.can_happen(name, event.0, system.description())?;
                simulation = simulation.end_after(event);
            }
        }
        Ok(match &self.progress {
            Some(progress) => simulation.monitor(progress.monitor()),
            None => simulation,
        })
    }

    /// A stage of the work that goes through the time of the run, seen by who watches it.
    pub(crate) fn stage<W>(&self, until: f64, work: impl FnOnce() -> W) -> W {
        if let Some(progress) = &self.progress {
            progress.runs_until(until);
        }
        let done = work();
        if let Some(progress) = &self.progress {
            progress.advance(1);
        }
        done
    }

    /// What takes part.
    pub(crate) fn effects(&self, description: &'static Description) -> Result<Effects, Refusal> {
        let mut off = BTreeSet::new();
        for (name, on) in &self.effects {
            for item in find_effects(description, name)? {
                match on {
                    true => off.remove(&item),
                    false => off.insert(item),
                };
            }
        }
        Ok(off.into_iter().fold(Effects::all(), Effects::without))
    }

    /// Refuses what is asked about the events of an item that is left out.
    pub(crate) fn can_happen(
        &self,
        asked: &str,
        subject: Subject,
        description: &'static Description,
    ) -> Result<(), Refusal> {
        let effects = self.effects(description)?;
        let name = subject.name(description);
        let item = Item::all(description).find(|item| item.name(description) == name);
        match item.is_none_or(|item| effects.includes(description, item)) {
            true => Ok(()),
            false => Err(Refusal::LeftOut {
                asked: asked.to_owned(),
                item: name,
            }),
        }
    }

    /// The state to start from; see [`Start::state`].
    pub(crate) fn start(
        &self,
        system: &AnySystem<f64>,
        simulation: &Simulation<'_, AnySystem<f64>>,
    ) -> Result<State<f64>, Refusal> {
        let start = Start::new(self, system.description())?;
        start
            .state(system, |reference, fixed| {
                simulation.consistent(0.0, reference, fixed)
            })
            .map_err(Refusal::Start)
    }
}

/// How the start of a request is found, names resolved.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    /// The named start, if there is one.
    from: Option<usize>,
    /// What is held exactly: which coordinate, whether its position or its velocity, and the value.
    pub(crate) held: Vec<(usize, Quantity, f64)>,
}

impl Start {
    /// Resolves the names.
    pub(crate) fn new(
        request: &Request,
        description: &'static Description,
    ) -> Result<Self, Refusal> {
        let from = match &request.from {
            Some(name) => Some(find_start(description, name)?),
            None => (!description.starts.is_empty()).then_some(0),
        };
        let mut start = Self {
            from,
            held: Vec::new(),
        };
        for (name, value) in &request.start {
            let (index, level) = find_state(description, name)?;
            start.hold(index, level, *value, name)?;
        }
        Ok(start)
    }

    /// Holds one more value.
    pub(crate) fn hold(
        &mut self,
        index: usize,
        level: Quantity,
        value: f64,
        name: &str,
    ) -> Result<(), Refusal> {
        if self.held.iter().any(|(i, l, _)| (*i, *l) == (index, level)) {
            return Err(Refusal::Repeated {
                name: name.to_owned(),
            });
        }
        self.held.push((index, level, value));
        Ok(())
    }

    /// The state of a system.
    ///
    /// Values given by name are held exactly. The others begin as in the named start and are then solved so that
    /// constraints hold, contacts closed there stay closed, and frictions that stick there stick; `consistent` does that.
    pub(crate) fn state(
        &self,
        system: &AnySystem<f64>,
        consistent: impl FnOnce(&State<f64>, &FixedComponents) -> Result<State<f64>, Error>,
    ) -> Result<State<f64>, Error> {
        let reference = match self.from {
            Some(index) => system.at(StartId(index)),
            None => system.state(),
        };
        if self.held.is_empty() {
            return Ok(reference);
        }
        let none = FixedComponents::default();
        let hold = |fixed: FixedComponents, &(index, level, value): &_| match level {
            Quantity::Position => fixed.q(CoordinateId(index), value),
            Quantity::Velocity => fixed.v(CoordinateId(index), value),
        };
        consistent(&reference, &self.held.iter().fold(none, hold))
    }
}

/// Index of the parameter called `name`.
pub(crate) fn find_parameter(
    description: &'static Description,
    name: &str,
) -> Result<usize, Refusal> {
    let known = || description.parameters.iter().map(|p| p.name);
    known()
        .position(|p| p == name)
        .ok_or_else(|| Refusal::unknown("parameter", name, known()))
}

/// Whether `name` means what is called so: by its own name, or by that of the array whose element it is.
fn means(name: &str, called: &str) -> bool {
    name == called || is_element(called, name)
}

/// Indices of what `name` means: a parameter, or all elements of an array.
pub(crate) fn find_parameters(
    description: &'static Description,
    name: &str,
) -> Result<Vec<usize>, Refusal> {
    let known = || description.parameters.iter().map(|p| p.name);
    let found = known().enumerate().filter(|(_, known)| means(name, known));
    let found: Vec<usize> = found.map(|(i, _)| i).collect();
    match found.is_empty() {
        true => Err(Refusal::unknown("parameter", name, known())),
        false => Ok(found),
    }
}

/// What `name` means of all that can be switched off: an item, or all elements of an array.
pub(crate) fn find_effects(
    description: &'static Description,
    name: &str,
) -> Result<Vec<Item>, Refusal> {
    let known = || Item::all(description);
    let called = |item: Item| item.name(description);
    let found: Vec<Item> = known().filter(|item| means(name, called(*item))).collect();
    match found.is_empty() {
        true if quaternion(description, name).is_some() => Err(Refusal::Attitude {
            body: name.to_owned(),
        }),
        true => Err(Refusal::unknown("effect", name, known().map(called))),
        false => Ok(found),
    }
}

/// Index of the named start called `name`.
pub(crate) fn find_start(description: &'static Description, name: &str) -> Result<usize, Refusal> {
    let known = || description.starts.iter().copied();
    known()
        .position(|start| start == name)
        .ok_or_else(|| Refusal::unknown("start", name, known()))
}

/// The coordinate called `name`.
pub(crate) fn find_coordinate(
    description: &'static Description,
    name: &str,
) -> Result<CoordinateId, Refusal> {
    let known = || description.coordinates.iter().map(|c| c.name);
    let found = known().position(|coordinate| coordinate == name);
    let unknown = || Refusal::unknown("coordinate", name, known());
    found.map(CoordinateId).ok_or_else(unknown)
}

/// The four coordinates of a body's attitude.
fn quaternion(description: &Description, body: &str) -> Option<String> {
    let mut constraints = description.constraints.iter();
    let first = constraints.find(|c| c.name == body)?.attitude?;
    let names = description.coordinates.iter().skip(first).take(4);
    Some(names.map(|c| c.name).collect::<Vec<_>>().join(", "))
}

/// Level of a number of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// A coordinate.
    Position,
    /// Its rate.
    Velocity,
}

/// `theta` or `der(theta)`, blanks ignored.
pub(crate) fn find_state(
    description: &'static Description,
    name: &str,
) -> Result<(usize, Quantity), Refusal> {
    let plain: String = name.chars().filter(|c| !c.is_whitespace()).collect();
    for (index, coordinate) in description.coordinates.iter().enumerate() {
        if plain == coordinate.name {
            return Ok((index, Quantity::Position));
        }
        if plain == velocity_name(coordinate.name) {
            return Ok((index, Quantity::Velocity));
        }
    }
    if let Some((body, _)) = plain.split_once('.')
        && let Some(coordinates) = quaternion(description, body)
    {
        return Err(Refusal::OfBody {
            name: plain,
            coordinates,
        });
    }
    let velocities: Vec<String> = description
        .coordinates
        .iter()
        .map(|c| velocity_name(c.name))
        .collect();
    let known = description
        .coordinates
        .iter()
        .map(|c| c.name)
        .chain(velocities.iter().map(String::as_str));
    Err(Refusal::unknown("coordinate or velocity", &plain, known))
}
