//! What happened: the event log, one entry per item that changed.

use super::owner::Owner;
use crate::handle::Subject;
use crate::mode::Mode;
use crate::modes::impact::OtherImpact;
use crate::state::State;
use crate::system::Description;

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
    /// Nothing changed, although the motion could go on in another mode as well.
    Ambiguous,
    /// A stop became true; the run ended.
    Stop,
    /// A mark became true, or its expression zero.
    Mark,
}

impl EventKind {
    /// One word: `lost`, `closed`, `impact`, `accumulates`, `slips`, `sticks`, `reverses`, `branches`, `ambiguous`, `stop`,
    /// `mark`.
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
            EventKind::Ambiguous => "ambiguous",
            EventKind::Stop => "stop",
            EventKind::Mark => "mark",
        }
    }

    /// Whether this can happen to such an item.
    pub fn happens_to(self, subject: Subject) -> bool {
        use EventKind::{
            Accumulates, Ambiguous, Branches, Closed, Impact, Lost, Mark, Reverses, Slips, Sticks,
            Stop,
        };
        match self {
            Lost | Closed | Impact | Accumulates { .. } => matches!(subject, Subject::Contact(_)),
            Slips | Sticks | Reverses => matches!(subject, Subject::Friction(_)),
            Ambiguous => matches!(subject, Subject::Contact(_) | Subject::Friction(_)),
            Branches => matches!(subject, Subject::Branch(_)),
            Stop => matches!(subject, Subject::Stop(_)),
            Mark => matches!(subject, Subject::Mark(_)),
        }
    }
}

/// One entry of the event log.
#[derive(Clone, PartialEq)]
pub struct Event<T> {
    pub(super) owner: Owner,
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
    /// Per row: whether the motion does not determine its force just before. The force given is then the one of least norm among
    /// those that contacts and friction allow. Empty where all forces are determined.
    pub undetermined: Vec<bool>,
    /// The same for the forces just after.
    pub undetermined_after: Vec<bool>,
    /// Impulse of every row, at an impact; else empty.
    pub impulses: Vec<T>,
    /// Whether the restitution was lowered so that the impact does not add energy.
    pub restitution_lowered: bool,
    /// Whether rows that depend on each other leave impulses of this impact undetermined; those given are the least that contacts and friction allow.
    pub impulses_undetermined: bool,
    /// Whether more than one mode could continue the motion, or more than one impact satisfies the law.
    pub ambiguous: bool,
    /// At an ambiguous impact: the others. They are not known of impacts in turn and of Poisson's law, nor of contacts so many
    /// that not all combinations are tried.
    pub other_impacts: Vec<OtherImpact<T>>,
}

/// What an event says beside its subject, kind and instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Around<'a, T> {
    pub before: &'a Mode,
    pub after: &'a Mode,
    pub state: &'a State<T>,
    pub state_after: &'a State<T>,
    pub forces: &'a [T],
    pub forces_after: &'a [T],
    pub undetermined: &'a [bool],
    pub undetermined_after: &'a [bool],
    pub impulses: &'a [T],
}

impl<T: crate::arithmetic::Scalar> Event<T> {
    /// An entry to be written over.
    pub(crate) fn blank(description: &'static Description) -> Self {
        let state = State::new(Vec::new(), Vec::new());
        Self {
            owner: Owner(description),
            time: T::default(),
            subject: Subject::Stop(0),
            kind: EventKind::Stop,
            before: Mode::open(description),
            after: Mode::open(description),
            state: state.clone(),
            state_after: state,
            forces: Vec::new(),
            forces_after: Vec::new(),
            undetermined: Vec::new(),
            undetermined_after: Vec::new(),
            impulses: Vec::new(),
            restitution_lowered: false,
            impulses_undetermined: false,
            ambiguous: false,
            other_impacts: Vec::new(),
        }
    }

    /// Writes over an entry, in its memory.
    pub(crate) fn write(&mut self, time: T, subject: Subject, kind: EventKind, a: Around<'_, T>) {
        let copy = |to: &mut Vec<T>, from: &[T]| {
            to.clear();
            to.extend_from_slice(from);
        };
        (self.time, self.subject, self.kind) = (time, subject, kind);
        self.before.clone_from(a.before);
        self.after.clone_from(a.after);
        self.state.clone_from(a.state);
        self.state_after.clone_from(a.state_after);
        copy(&mut self.forces, a.forces);
        copy(&mut self.forces_after, a.forces_after);
        copy(&mut self.impulses, a.impulses);
        self.undetermined.clear();
        self.undetermined.extend_from_slice(a.undetermined);
        self.undetermined_after.clear();
        self.undetermined_after
            .extend_from_slice(a.undetermined_after);
        self.restitution_lowered = false;
        self.impulses_undetermined = false;
        self.ambiguous = false;
        self.other_impacts.clear();
    }
}
