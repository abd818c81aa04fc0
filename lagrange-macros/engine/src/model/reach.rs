//! What an expression may contain where it stands, and what it does contain.

use super::elaborate::Elaboration;
use crate::diagnostics::{Code, Extent};
use crate::symbolic::ExprId;

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

impl Elaboration<'_> {
    /// The highest kind of symbol in expressions.
    pub fn depth(&self, expressions: &[ExprId]) -> Depth {
        let symbols = expressions
            .iter()
            .flat_map(|&e| self.system.pool.symbols(e));
        let depths = symbols.map(|symbol| self.depths[symbol.index()]);
        depths.max().unwrap_or(Depth::Parameter)
    }

    /// Whether something this deep may stand in this context; if not, says so at `text`.
    pub fn admit(
        &mut self,
        depth: Depth,
        context: Context,
        text: &dyn std::fmt::Display,
        at: Extent,
    ) -> Option<()> {
        let (code, hint) = match (context.reach, depth) {
            (Reach::Definition | Reach::Outputs, _) | (_, Depth::Parameter) => return Some(()),
            (Reach::Parameters, _) => (Code::CoordinateHere, "use fields, numbers and `t`"),
            (_, Depth::Position) => return Some(()),
            (Reach::Positions, Depth::Velocity) => (
                Code::VelocityHere,
                "velocities may stand in `kinetic`, `lagrangian`, `constraint`, slip, `force`, `dissipation` and outputs",
            ),
            (_, Depth::Velocity) => return Some(()),
            (_, Depth::Acceleration) => {
                self.sink.report(Code::AccelerationHere, at, &[text]);
                return None;
            }
            (Reach::Loads | Reach::Forces, Depth::Force) => return Some(()),
            (_, Depth::Force) => {
                self.sink.report(Code::OutputOnly, at, &[text]);
                return None;
            }
        };
        self.sink.report(code, at, &[&context.what, text, &hint]);
        None
    }
}
