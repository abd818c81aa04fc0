//! What an expression may contain where it stands, and what it does contain.

/// The highest kind of symbol in an expression.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Depth {
    /// Parameters and t.
    Parameter,
    /// q
    Position,
    /// v
    Velocity,
    /// v̇
    Acceleration,
    /// λ, and values of force items.
    Force,
}

/// What may be used where an expression stands.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Reach {
    /// Parameters and t.
    Parameters,
    /// … and coordinates.
    Positions,
    /// … and velocities.
    Motion,
    /// … and forces of contacts and constraints, but no accelerations.
    Loads,
    /// … and those of frictions and applied forces.
    Forces,
    /// A definition: everything without names of items; where it is used decides.
    Definition,
    /// Everything.
    Outputs,
}

/// What is written as `normal = …`.
pub(super) const NORMAL_FORCE: &str = "a normal force";

/// Where an expression stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Context {
    pub reach: Reach,
    /// For messages: `a potential energy`.
    pub what: &'static str,
}

impl Context {
    pub const fn new(reach: Reach, what: &'static str) -> Context {
        Context { reach, what }
    }
}

/// What a named start says.
pub(super) const START: Context = Context::new(Reach::Parameters, "a start");
