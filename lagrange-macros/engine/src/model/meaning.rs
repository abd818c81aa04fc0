//! What names stand for.

use super::depth::Depth;
use super::value::Value;
use crate::sorted::SortedMap;

/// A kind of item.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    Field,
    Coordinate,
    Definition,
    Output,
    Kinetic,
    Potential,
    Constraint,
    Contact,
    Friction,
    Force,
    Dissipation,
    Start,
    Stop,
    Mark,
    Check,
}

impl Kind {
    /// For messages.
    pub fn text(self) -> &'static str {
        match self {
            Kind::Field => "parameter",
            Kind::Coordinate => "coordinate",
            Kind::Definition => "definition",
            Kind::Output => "quantity of `observe`",
            Kind::Kinetic => "kinetic energy",
            Kind::Potential => "potential energy",
            Kind::Constraint => "constraint",
            Kind::Contact => "contact",
            Kind::Friction => "friction",
            Kind::Force => "force",
            Kind::Dissipation => "dissipation",
            Kind::Start => "start",
            Kind::Stop => "stop",
            Kind::Mark => "mark",
            Kind::Check => "check",
        }
    }
}

impl Kind {
    /// Whether its name can stand for a force.
    pub fn has_force(self) -> bool {
        matches!(
            self,
            Kind::Contact | Kind::Constraint | Kind::Friction | Kind::Force
        )
    }
}

/// What a name stands for.
#[derive(Clone, Debug)]
pub(super) enum Meaning {
    /// A value; indices of a list begin at `lower`.
    Value {
        value: Value,
        lower: i64,
        depth: Depth,
    },
    /// A definition or output that is evaluated when it is first used: index into the definitions.
    Pending(usize),
    /// It is being evaluated.
    Busy,
    /// An item: its elements, as indices into the system's list of that kind.
    Item {
        elements: Vec<usize>,
        lower: Option<i64>,
    },
    /// It could not be made sense of, which has been reported.
    Poisoned,
}

/// A name of the namespace.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub kind: Kind,
    pub meaning: Meaning,
}

/// The namespace.
pub(super) type Names = SortedMap<String, Entry>;
