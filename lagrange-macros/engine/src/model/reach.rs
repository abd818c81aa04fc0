//! Whether an expression contains what it may where it stands.

use super::depth::{Context, Depth, Reach};
use super::elaboration::Elaboration;
use crate::diagnostics::{Code, Extent};
use crate::symbolic::ExprId;

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
            (Reach::Parameters, _) => (Code::CoordinateHere, "use parameters, numbers and `t`"),
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
