//! Hard cases: runs with an answer known by other means, and how far from it they end.
//!
//! A [`Case`] runs its scene and gives [`Figure`]s: errors, relative unless a unit is named, each with the bound that it must keep.

use core::fmt;
use lagrange_core::prelude::{Error, Failure};

/// How long the long cases run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// A few seconds in all.
    Short,
    /// A hundred thousand periods where the question is endurance.
    Long,
}

/// One measured number and the bound that it must keep.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What was measured; an error is relative unless it names a unit.
    pub what: String,
    /// The number found, ≥ 0.
    pub value: f64,
    /// Largest that will do.
    pub bound: f64,
}

impl Figure {
    /// A figure and its bound.
    pub fn new(what: impl Into<String>, value: f64, bound: f64) -> Self {
        let what = what.into();
        Self { what, value, bound }
    }

    /// Whether it keeps its bound; what is not a number does not.
    pub fn holds(&self) -> bool {
        self.value <= self.bound
    }
}

/// What measures a case.
pub type Measure = fn(Extent) -> Result<Vec<Figure>, Surprise>;

/// A hard case.
pub struct Case {
    /// Name, for `--only`.
    pub name: &'static str,
    /// Scene in the catalogue.
    pub scene: &'static str,
    /// What usually goes wrong.
    pub trouble: &'static str,
    /// Runs it and compares.
    pub measure: Measure,
}

/// What a case came to.
pub struct Report {
    /// The case.
    pub case: &'static Case,
    /// Its figures; empty if it could not be measured.
    pub figures: Vec<Figure>,
    /// Why it could not be measured.
    pub surprise: Option<Surprise>,
}

impl Report {
    /// Whether everything was measured and keeps its bound.
    pub fn holds(&self) -> bool {
        self.surprise.is_none() && self.figures.iter().all(Figure::holds)
    }
}

impl Case {
    /// Runs it.
    pub fn run(&'static self, extent: Extent) -> Report {
        let (figures, surprise) = match (self.measure)(extent) {
            Ok(figures) => (figures, None),
            Err(surprise) => (Vec::new(), Some(surprise)),
        };
        Report {
            case: self,
            figures,
            surprise,
        }
    }
}

/// Why a case could not be measured.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Surprise {
    /// The run failed.
    Failed(Error),
    /// It should have failed, with an error that is described.
    NotRefused {
        /// What was expected.
        expected: &'static str,
        /// The error that came instead, if any.
        found: Option<Error>,
    },
    /// Other things happened.
    Story {
        /// Events found, `floor impact`.
        found: Vec<String>,
        /// Events expected.
        expected: Vec<String>,
    },
    /// An event did not happen.
    Missing {
        /// `item kind`.
        event: String,
    },
}

impl fmt::Display for Surprise {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Surprise::Failed(error) => error.fmt(f),
            Surprise::NotRefused {
                expected,
                found: None,
            } => write!(f, "no error, instead of: {expected}"),
            Surprise::NotRefused {
                expected,
                found: Some(error),
            } => write!(f, "`{error}` instead of: {expected}"),
            Surprise::Story { found, expected } => write!(
                f,
                "what happened: {}; expected: {}",
                found.join(", "),
                expected.join(", ")
            ),
            Surprise::Missing { event } => write!(f, "`{event}` did not happen"),
        }
    }
}

impl core::error::Error for Surprise {}

impl From<Error> for Surprise {
    fn from(error: Error) -> Self {
        Surprise::Failed(error)
    }
}

impl From<Failure> for Surprise {
    fn from(failure: Failure) -> Self {
        Surprise::Failed(failure.error)
    }
}
