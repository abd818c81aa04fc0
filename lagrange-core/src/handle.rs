//! Handles: typed indices of the items of a system, emitted as associated constants (`MassOnWheel::RIM`).
//!
//! Each is an index into the table of the same name in [`crate::system::Description`]; the number inside is public, so
//! that systems that are not derived can make them.

use crate::effects::Item;

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

macro_rules! items {
    ($($handle:ident $item:ident)*) => {$(
        impl From<$handle> for Item {
            fn from($handle(index): $handle) -> Item {
                Item::$item(index)
            }
        }
    )*};
}

// What a scene can leave out, `Effects::all().without(MassOnWheel::RIM)`.
items! {
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
