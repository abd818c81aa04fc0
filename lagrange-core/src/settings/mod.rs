//! What is asked of a run, beside its system.

mod check;

pub(crate) use check::{check_span, check_start, is_single};

use crate::dynamics::Equations;
use crate::effects::Effects;
use crate::handle::{CoordinateId, Subject};
use crate::integrate::{Method, Tolerance, least_size};
use crate::monitor::Monitor;
use crate::system::Impacts;
use crate::trajectory::{Event, EventKind};

/// How exact a run is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Goal {
    /// As the tolerance has it.
    Tolerance,
    /// The same, with an estimate of the error.
    Estimate,
    /// Within this error.
    Error(f64),
}

/// Everything about a run but the system.
#[derive(Clone, Debug)]
pub(crate) struct Settings {
    pub effects: Effects,
    pub goal: Goal,
    pub tolerance: f64,
    /// Absolute tolerances of single coordinates as they were given; `sizes` are made of them.
    pub absolute: Vec<(CoordinateId, f64)>,
    /// Per coordinate: errors of its position and its velocity are relative above this size and absolute below; empty: 1 for all.
    pub sizes: Vec<f64>,
    pub method: Method,
    /// Whether steps begin and grow more slowly than the method has it: how fast they may grow is the same at all tolerances, so that two runs could
    /// begin with the same steps, and with the same errors; and what Taylor series follow exactly would be rounded in the same way.
    pub careful: bool,
    pub project_start: bool,
    /// What evaluates the equations of motion.
    pub equations: Equations,
    pub record: bool,
    /// The run ends once each of these has happened; empty: it does not.
    pub last_events: Vec<Awaited>,
    /// As declared if `None`.
    pub impacts: Option<Impacts>,
    pub max_events: usize,
    pub max_steps: usize,
    pub monitor: Option<Monitor>,
}

impl Settings {
    /// The same, with the sizes of so many coordinates, once the tolerance and the absolute ones are known.
    pub fn completed(&self, coordinates: usize) -> Self {
        let asked = match self.goal {
            Goal::Error(error) => error,
            Goal::Tolerance | Goal::Estimate => self.tolerance,
        };
        let mut sizes = Vec::new();
        if !self.absolute.is_empty() {
            sizes.resize(coordinates, 1.0);
        }
        for &(CoordinateId(i), absolute) in &self.absolute {
            // Items that the system does not have are refused when a run begins.
            sizes.resize(sizes.len().max(i + 1), 1.0);
            sizes[i] = absolute / asked;
        }
        Self {
            sizes,
            ..self.clone()
        }
    }

    /// What a step may get wrong.
    pub fn per_step(&self) -> Tolerance<'_> {
        Tolerance {
            sizes: &self.sizes,
            ..Tolerance::both(self.tolerance)
        }
    }

    /// Error that is below the tolerance for a position or velocity of the coordinate that is so large.
    pub fn allowed(&self, coordinate: usize, size: f64) -> f64 {
        self.tolerance * size.max(least_size(&self.sizes, coordinate))
    }
}

/// An event that a run can end after.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Awaited {
    /// What it is about.
    pub subject: Subject,
    /// What happens to it (whatever an [`EventKind::Accumulates`] counts); `None`: anything.
    pub kind: Option<EventKind>,
    /// Which of these events it is, counted from 1.
    pub number: usize,
}

impl Awaited {
    /// Whether an event is one of these, whatever its number.
    pub fn is<T>(&self, event: &Event<T>) -> bool {
        let same = |kind: EventKind| kind.word() == event.kind.word();
        event.subject == self.subject && self.kind.is_none_or(same)
    }
}

impl<I: Into<Subject>> From<I> for Awaited {
    fn from(item: I) -> Awaited {
        Awaited {
            subject: item.into(),
            kind: None,
            number: 1,
        }
    }
}

impl<I: Into<Subject>> From<(I, EventKind)> for Awaited {
    fn from((item, kind): (I, EventKind)) -> Awaited {
        (item, kind, 1).into()
    }
}

impl<I: Into<Subject>> From<(I, EventKind, usize)> for Awaited {
    fn from((item, kind, number): (I, EventKind, usize)) -> Awaited {
        Awaited {
            subject: item.into(),
            kind: Some(kind),
            number,
        }
    }
}
