//! Powers of what is chosen: max(0, d)^p is 0 on one side, and d^p on the other.

use super::table::Table;
use super::{ExprId, Node, Pool, Rational};

impl Pool {
    /// Expressions in which no power above one, and of no whole number, is of a choice with zero on one side: what is chosen is raised where it is. A power of zero
    /// has a value, and no Taylor series that could begin.
    pub fn raise_sides(&mut self, roots: &[ExprId]) -> Vec<ExprId> {
        let reachable = self.iter_reachable(roots);
        if !reachable.iter().any(|&e| self.raised_choice(e).is_some()) {
            return roots.to_vec();
        }
        let mut known = Table::default();
        let raise = |&root: &ExprId| {
            let raised = self.ascend(
                root,
                &mut known,
                |_, _| false,
                |pool, e, known| {
                    let mut e = pool.with_children(e, known);
                    while let Some((choice, exponent)) = pool.raised_choice(e) {
                        let Node::Select {
                            branch,
                            then,
                            otherwise,
                        } = *pool.node(choice)
                        else {
                            break;
                        };
                        let sides = [then, otherwise].map(|side| pool.raise(side, exponent));
                        let power = pool.raise(choice, exponent);
                        let rest = match pool.div(e, power) {
                            Some(rest) => rest,
                            None => break,
                        };
                        let chosen = pool.select(branch, sides[0], sides[1]);
                        e = pool.mul(rest, chosen);
                    }
                    e
                },
            );
            raised.unwrap_or(root)
        };
        roots.iter().map(raise).collect()
    }

    /// A factor that is such a power: what is chosen, and the exponent.
    fn raised_choice(&self, e: ExprId) -> Option<(ExprId, Rational)> {
        let Node::Product(factors) = self.node(e) else {
            return None;
        };
        let is_choice = |base: ExprId| match *self.node(base) {
            Node::Select {
                then, otherwise, ..
            } => self.is_zero(then) || self.is_zero(otherwise),
            _ => false,
        };
        let above_one = |p: Rational| p > Rational::ONE && !p.is_integer();
        let mut factors = factors.iter().copied();
        factors.find(|&(base, p)| above_one(p) && is_choice(base))
    }
}
