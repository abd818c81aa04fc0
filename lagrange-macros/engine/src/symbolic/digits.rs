//! Which form of a sum keeps its digits: a sum of squares that comes near to zero, as the distance of two points does, loses them multiplied out.

use super::table::Flags;
use super::{ExprId, Node, Pool, Rational};

/// What has been looked at.
const VISITED: u32 = 0;

impl Pool {
    /// What of an expression stands under roots and in denominators: errors do harm where that comes near to zero.
    fn under_roots(&self, e: ExprId) -> Vec<ExprId> {
        let mut bases = Vec::new();
        let mut seen = Flags::default();
        let mut stack = vec![e];
        while let Some(e) = stack.pop() {
            if !self.varies(e) || !seen.raise(e, VISITED) {
                continue;
            }
            let node = self.node(e);
            node.for_each_child(|child| stack.push(child));
            if let Node::Product(factors) = node {
                let harmed = factors.iter().filter(|&&(base, exponent)| {
                    let keeps = exponent.is_integer() && !exponent.is_negative();
                    !keeps && self.varies(base)
                });
                bases.extend(harmed.map(|&(base, _)| base));
            }
        }
        bases
    }

    /// Of these the sums of squares that could be multiplied out.
    pub(super) fn squares_under_roots(&self, e: ExprId) -> Vec<ExprId> {
        let is_sum = |base: ExprId| matches!(self.node(base), Node::Sum { .. });
        let has_square = |e: ExprId| match self.node(e) {
            Node::Product(factors) => factors.iter().any(|&(base, _)| is_sum(base)),
            _ => false,
        };
        let mut bases = self.under_roots(e);
        bases.retain(|&base| {
            let squares = match self.node(base) {
                Node::Sum { terms, .. } => terms.iter().any(|&(term, _)| has_square(term)),
                _ => has_square(base),
            };
            squares && self.is_sum_of_squares(base)
        });
        bases
    }

    /// How many sums under roots and in denominators can lose their digits.
    pub(super) fn losses(&self, form: ExprId) -> usize {
        let mut bases = self.under_roots(form);
        bases.retain(|&base| {
            matches!(self.node(base), Node::Sum { .. }) && !self.is_sum_of_squares(base)
        });
        bases.sort_unstable();
        bases.dedup();
        bases.len()
    }

    /// Whether an expression is a sum of even powers, with coefficients that are positive.
    pub(super) fn is_sum_of_squares(&self, e: ExprId) -> bool {
        match self.node(e) {
            Node::Number(number) => !number.is_negative(),
            Node::Sum { constant, terms } => {
                let positive = |number: &Rational| !number.is_negative();
                positive(constant)
                    && (terms.iter()).all(|(term, c)| positive(c) && self.is_sum_of_squares(*term))
            }
            Node::Product(factors) => factors.iter().all(|&(base, exponent)| {
                let even = exponent.is_integer() && exponent.numerator() % 2 == 0;
                even || exponent.is_integer() && self.is_sum_of_squares(base)
            }),
            _ => false,
        }
    }
}
