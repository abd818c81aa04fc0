//! Parts of an expression that are computed as a whole.
//!
//! Building flattens: Σ over s of the sums A₁ ⊂ A₂ ⊂ … becomes one sum with as many terms as all of them together. As
//! groups they stay what they are, each made of the one before it, and a chain of n of them costs n operations, not n².

use super::{ExprId, Node, Pool};

impl Pool {
    /// e, kept whole by sums and products around it; what is no sum or product is itself.
    pub fn group(&mut self, e: ExprId) -> ExprId {
        match self.node(e) {
            Node::Sum { .. } | Node::Product(_) => self.intern(Node::Group(e)),
            _ => e,
        }
    }

    /// The same for a sum of several terms; others are themselves.
    pub fn group_sum(&mut self, e: ExprId) -> ExprId {
        match self.node(e) {
            Node::Sum { constant, terms } if terms.len() > 1 || !constant.is_zero() => {
                self.group(e)
            }
            _ => e,
        }
    }
}
