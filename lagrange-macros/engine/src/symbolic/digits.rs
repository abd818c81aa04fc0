//! Which form of a sum keeps its digits: a sum of squares that comes near to zero, as the distance of two points does, loses them multiplied out.

use super::table::Flags;
use super::{ExprId, Node, Pool, Rational};

/// What has been looked at.
const VISITED: u32 = 0;

impl Pool {
    /// The sums of an expression that stand under roots and in denominators: errors do harm where they come near to zero.
    pub(super) fn sums_under_roots(&self, e: ExprId) -> Vec<ExprId> {
        let mut sums = Vec::new();
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
                    !keeps && matches!(self.node(base), Node::Sum { .. }) && self.varies(base)
                });
                sums.extend(harmed.map(|&(base, _)| base));
            }
        }
        sums
    }

    /// How many of them can lose their digits.
    pub(super) fn losses(&self, form: ExprId) -> usize {
        let mut sums = self.sums_under_roots(form);
        sums.retain(|&sum| !self.is_sum_of_squares(sum));
        sums.sort_unstable();
        sums.dedup();
        sums.len()
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
