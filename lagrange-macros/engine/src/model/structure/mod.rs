//! What constraints say together: which follow from others or contradict them, which velocity constraints are
//! constraints on positions, which coordinates were put into the energies too early, which dissipations damp nothing,
//! and which gaps cannot close.
//!
//! Derivatives are exact; ranks are taken in floating point at a few arbitrary states, which need not be on the
//! constraints: what holds there holds identically.

mod absorbed;
mod dependent;
mod feeding;
mod integrable;
mod one_sided;

use super::elaboration::Elaboration;
use super::{Constraint, Level};
use crate::ast::Declaration;
use crate::symbolic::{ExprId, Pool, Symbol};

/// Number of states that are looked at.
const STATES: u32 = 3;

/// Below this, relative to what was subtracted, a number is zero. States are arbitrary, so a number that is not zero is
/// hardly ever small.
const ZERO: f64 = 1e-9;

/// a(q,t) and b(q,t) of a v + b: the rate of a position constraint, or a velocity constraint.
struct Pfaffian {
    /// One per coordinate.
    slope: Vec<ExprId>,
    bias: ExprId,
}

impl Elaboration<'_> {
    /// Checks constraints, and remarks on them.
    pub fn structure(&mut self, declaration: &Declaration) {
        let before = self.sink.count();
        let rows = self.pfaffians();
        self.dependent(&rows);
        self.same_twice();
        if self.sink.count() > before {
            return;
        }
        self.integrable(declaration, &rows);
        self.absorbed();
        self.feeding();
        self.one_sided();
    }

    /// The rows of all constraints.
    fn pfaffians(&mut self) -> Vec<Pfaffian> {
        let (positions, velocities) = (self.positions(), self.velocities());
        let time = self.system.time;
        let pool = &mut self.system.pool;
        let constraints = self.system.constraints.iter();
        constraints
            .map(|constraint| match constraint.level {
                Level::Position => gradient(pool, constraint.residual, &positions, time),
                Level::Velocity => {
                    let zero = pool.integer(0);
                    let rest: Vec<_> = velocities.iter().map(|&v| (v, zero)).collect();
                    Pfaffian {
                        slope: slopes(pool, constraint.residual, &velocities),
                        bias: pool.substitute(constraint.residual, &rest),
                    }
                }
            })
            .collect()
    }

    /// Symbols of all positions.
    fn positions(&self) -> Vec<Symbol> {
        let coordinates = self.system.coordinates.iter();
        coordinates.map(|coordinate| coordinate.position).collect()
    }

    /// Values at state `number`, or nothing if one of them is not finite. Parameters are those of every state.
    fn values(&self, expressions: &[ExprId], number: u32) -> Option<Vec<f64>> {
        let value = |symbol: Symbol| {
            let varies = self.depths[symbol.index()] > super::depth::Depth::Parameter
                || symbol == self.system.time;
            let state = if varies { f64::from(number) } else { 0.0 };
            // Irrational steps: no two symbols are in a simple ratio.
            0.4 + ((symbol.index() + 1) as f64 * 0.618_033_988_749 + state * 0.414_213_562_373)
                .fract()
        };
        let values = self.system.pool.evaluate(expressions, &value, &|_| true);
        values
            .iter()
            .all(|value| value.is_finite())
            .then_some(values)
    }
}

/// ∂e/∂xᵢ
fn slopes(pool: &mut Pool, e: ExprId, symbols: &[Symbol]) -> Vec<ExprId> {
    let occurring = pool.symbols(e);
    let zero = pool.integer(0);
    let slope = |&symbol: &Symbol| match occurring.contains(&symbol) {
        true => pool.differentiate(e, symbol),
        false => zero,
    };
    symbols.iter().map(slope).collect()
}

fn gradient(pool: &mut Pool, e: ExprId, positions: &[Symbol], time: Symbol) -> Pfaffian {
    Pfaffian {
        slope: slopes(pool, e, positions),
        bias: pool.differentiate(e, time),
    }
}

/// Whether a constraint holds in every mode and has no branches.
fn is_plain(pool: &Pool, constraint: &Constraint) -> bool {
    constraint.while_contact.is_none() && pool.branches(constraint.residual).is_empty()
}
