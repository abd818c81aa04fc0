//! Handles: typed indices of the items of a system, emitted as associated constants (`MassOnWheel::RIM`).
//!
//! Each is an index into the table of the same name in [`crate::system::Description`]; the number inside is public, for programs
//! that work on any system, [`AnySystem`](crate::system::AnySystem), and know no names. A handle does not know its system: given to
//! another one it names what has its place there, and where there is nothing, results panic and say so, and runs are refused.

use crate::effects::Item;
use crate::system::Description;

macro_rules! handles {
    ($($(#[$documentation:meta])* $name:ident)*) => {$(
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub usize);
    )*};
}

handles! {
    /// A generalized coordinate, [`crate::system::Description::coordinates`].
    CoordinateId
    /// A named kinetic energy, [`crate::system::Description::kinetic`].
    KineticId
    /// A named potential energy, [`crate::system::Description::potential`].
    PotentialId
    /// An equality constraint, [`crate::system::Description::constraints`].
    ConstraintId
    /// A one-sided contact, [`crate::system::Description::contacts`].
    ContactId
    /// A friction, [`crate::system::Description::frictions`].
    FrictionId
    /// An applied force, [`crate::system::Description::forces`].
    ForceId
    /// A Rayleigh dissipation, [`crate::system::Description::dissipations`].
    DissipationId
    /// An extra output, [`crate::system::Description::observes`].
    ObserveId
    /// What ends a run, [`crate::system::Description::stops`].
    StopId
    /// What is logged, [`crate::system::Description::marks`].
    MarkId
    /// A named start, [`crate::system::Description::starts`].
    StartId
}

/// The element that a handle names.
#[track_caller]
pub(crate) fn named<'a, X>(list: &'a [X], index: usize, kind: &str) -> &'a X {
    check(index, list.len(), kind);
    &list[index]
}

/// The same, to be changed.
#[track_caller]
pub(crate) fn named_mut<'a, X>(list: &'a mut [X], index: usize, kind: &str) -> &'a mut X {
    check(index, list.len(), kind);
    &mut list[index]
}

/// Only a handle of another system names nothing.
#[track_caller]
fn check(index: usize, count: usize, kind: &str) {
    assert!(
        index < count,
        "there is no {kind} {index} among {count}, counted from 0: this handle is one of another system"
    );
}

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
            Subject::Branch(i) => description.branches[i].then,
            Subject::Stop(i) => description.stops[i].name,
            Subject::Mark(i) => description.marks[i].name,
        }
    }

    /// Its index, and how many of its kind there are; the system has no such item if the first is not below the second.
    pub(crate) fn place(self, description: &Description) -> (usize, usize) {
        let d = description;
        match self {
            Subject::Contact(i) => (i, d.contacts.len()),
            Subject::Friction(i) => (i, d.frictions.len()),
            Subject::Branch(i) => (i, d.branches.len()),
            Subject::Stop(i) => (i, d.stops.len()),
            Subject::Mark(i) => (i, d.marks.len()),
        }
    }

    /// What can be left out of a run; a branch cannot.
    pub(crate) fn item(self) -> Option<Item> {
        match self {
            Subject::Contact(i) => Some(Item::Contact(i)),
            Subject::Friction(i) => Some(Item::Friction(i)),
            Subject::Branch(_) => None,
            Subject::Stop(i) => Some(Item::Stop(i)),
            Subject::Mark(i) => Some(Item::Mark(i)),
        }
    }
}

/// What has a multiplier: a constraint, a contact or a friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reaction {
    /// Constraint i.
    Constraint(usize),
    /// Contact i.
    Contact(usize),
    /// Friction i.
    Friction(usize),
}

impl Reaction {
    /// Its (first) row.
    #[track_caller]
    pub(crate) fn row(self, description: &Description) -> usize {
        match self {
            Reaction::Constraint(i) => named(description.constraints, i, "constraint").row,
            Reaction::Contact(i) => named(description.contacts, i, "contact").row,
            Reaction::Friction(i) => named(description.frictions, i, "friction").row,
        }
    }
}

macro_rules! conversions {
    ($target:ident: $($handle:ident $variant:ident)*) => {$(
        impl From<$handle> for $target {
            fn from($handle(index): $handle) -> $target {
                $target::$variant(index)
            }
        }
    )*};
}

// What a scene can leave out, `Effects::all().without(MassOnWheel::RIM)`.
conversions! { Item:
    KineticId Kinetic
    PotentialId Potential
    ConstraintId Constraint
    ContactId Contact
    FrictionId Friction
    ForceId Force
    DissipationId Dissipation
    ObserveId Observe
    StopId Stop
    MarkId Mark
}

// What results give the force of, `now.force(MassOnWheel::RIM)`.
conversions! { Reaction:
    ConstraintId Constraint
    ContactId Contact
    FrictionId Friction
}

// What has events, `simulation.end_after(MassOnWheel::FLOOR)`.
conversions! { Subject:
    ContactId Contact
    FrictionId Friction
    StopId Stop
    MarkId Mark
}
