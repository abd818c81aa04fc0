//! What happened: the event log, one entry per item that changed.

use crate::handle::StartId;
use crate::mode::Mode;
use crate::system::{Description, System};
use core::fmt;

/// Positions and velocities.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct State<T> {
    /// q, one per coordinate.
    pub q: Vec<T>,
    /// v = dq/dt.
    pub v: Vec<T>,
}

/// Named starts as states.
pub trait Starts: System {
    /// The state of a named start at time 0.
    fn at(&self, start: StartId) -> State<Self::Scalar> {
        let n = Self::DESCRIPTION.coordinates.len();
        let zero = Self::Scalar::default();
        let mut state = State {
            q: vec![zero; n],
            v: vec![zero; n],
        };
        System::start(self, start.0, zero, &mut state.q, &mut state.v);
        state
    }
}

impl<S: System> Starts for S {}

/// What an event is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Contact i.
    Contact(usize),
    /// Friction i.
    Friction(usize),
    /// Piecewise branch i.
    Branch(usize),
    /// Stop i.
    Stop(usize),
    /// Mark i.
    Mark(usize),
}

impl Subject {
    /// Its name in the declaration.
    pub fn name(self, description: &'static Description) -> &'static str {
        match self {
            Subject::Contact(i) => description.contacts[i].name,
            Subject::Friction(i) => description.frictions[i].name,
            Subject::Branch(i) => description.branches[i].text,
            Subject::Stop(i) => description.stops[i].name,
            Subject::Mark(i) => description.marks[i].name,
        }
    }
}

/// What happened to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum EventKind {
    /// A contact opened.
    Lost,
    /// A contact closed and stays.
    Closed,
    /// A contact was hit: velocities jumped.
    Impact,
    /// Infinitely many impacts in finite time have ended; the contact closes.
    Accumulates {
        /// Number of impacts that were followed one by one.
        impacts: usize,
    },
    /// A friction began to slip.
    Slips,
    /// A friction began to stick.
    Sticks,
    /// A slip changed direction without sticking.
    Reverses,
    /// A piecewise function changed its branch.
    Branches,
    /// A stop became true; the run ended.
    Stop,
    /// A mark became true, or its expression zero.
    Mark,
}

impl EventKind {
    /// One word: `lost`, `closed`, `impact`, `accumulates`, `slips`, `sticks`, `reverses`, `branches`, `stop`, `mark`.
    pub fn word(self) -> &'static str {
        match self {
            EventKind::Lost => "lost",
            EventKind::Closed => "closed",
            EventKind::Impact => "impact",
            EventKind::Accumulates { .. } => "accumulates",
            EventKind::Slips => "slips",
            EventKind::Sticks => "sticks",
            EventKind::Reverses => "reverses",
            EventKind::Branches => "branches",
            EventKind::Stop => "stop",
            EventKind::Mark => "mark",
        }
    }
}

/// One entry of the event log.
#[derive(Clone, Debug, PartialEq)]
pub struct Event<T> {
    /// Time, s.
    pub time: T,
    /// What it is about.
    pub subject: Subject,
    /// What happened.
    pub kind: EventKind,
    /// Mode just before.
    pub before: Mode,
    /// Mode just after.
    pub after: Mode,
    /// State just before.
    pub state: State<T>,
    /// State just after (differs in v at an impact).
    pub state_after: State<T>,
    /// λ of every row just before; 0 where a row does not act; for a friction its force along +slip.
    pub forces: Vec<T>,
    /// λ of every row just after.
    pub forces_after: Vec<T>,
    /// Impulse of every row, at an impact; else empty.
    pub impulses: Vec<T>,
    /// Whether the restitution was lowered so that the impact does not add energy.
    pub restitution_lowered: bool,
    /// Whether more than one mode could continue the motion.
    pub ambiguous: bool,
}

impl<T: crate::arithmetic::Scalar> Event<T> {
    /// The event as a sentence, `t = 2.461759150: grip slips (0.62385 …)`.
    pub fn sentence(&self, description: &'static Description) -> String {
        let name = self.subject.name(description);
        let what = match self.kind {
            EventKind::Lost => "lets go",
            EventKind::Closed => "closes and holds",
            EventKind::Impact => "is hit",
            EventKind::Accumulates { .. } => "has bounced infinitely often",
            EventKind::Slips => "starts to slip",
            EventKind::Sticks => "sticks",
            EventKind::Reverses => "reverses its slip",
            EventKind::Branches => "changes branch",
            EventKind::Stop => "ends the run",
            EventKind::Mark => "is reached",
        };
        format!("t = {:.9} s: {name} {what}", self.time.value())
    }
}

impl fmt::Display for EventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
