//! Parts of an expression that are computed as a whole.
//!
//! Building flattens: Σ over s of the sums A₁ ⊂ A₂ ⊂ … becomes one sum with as many terms as all of them together. As
//! groups they stay what they are, each made of the one before it, and a chain of n of them costs n operations, not n².

use super::table::Table;
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

    /// The expressions with every varying sum that stands in them more than once kept whole, simplified by itself.
    pub fn keep_shared(&mut self, roots: &[ExprId]) -> Vec<ExprId> {
        let reachable = self.iter_reachable(roots);
        let mut uses = vec![0; reachable.last().map_or(0, |last| last.index() + 1)];
        for &e in &reachable {
            self.node(e)
                .for_each_child(|child| uses[child.index()] += 1);
        }
        let mut known = Table::default();
        let kept = roots.iter().map(|&root| {
            let never = |_: &Pool, _| false;
            let kept = self.ascend(root, &mut known, never, |pool, e, known| {
                let shared = uses[e.index()] > 1 && pool.varies(e);
                let e = pool.with_children(e, known);
                match pool.node(e) {
                    Node::Sum { .. } if shared => {
                        let simple = pool.simplify(e);
                        pool.group_sum(simple)
                    }
                    _ => e,
                }
            });
            kept.unwrap_or(root)
        });
        kept.collect()
    }

    /// How many terms the largest of the expressions has once it is multiplied out, where that is not done.
    pub fn terms_multiplied_out(&self, roots: &[ExprId]) -> f64 {
        let reachable = self.iter_reachable(roots);
        let mut counts = vec![1.0_f64; reachable.last().map_or(0, |last| last.index() + 1)];
        for &e in &reachable {
            counts[e.index()] = match self.node(e) {
                Node::Sum { terms, .. } => terms.iter().map(|(term, _)| counts[term.index()]).sum(),
                Node::Product(factors) => {
                    let powers = factors.iter().map(|&(base, exponent)| {
                        let exponent = exponent.to_integer().unwrap_or(0).max(0);
                        counts[base.index()].powi(exponent as i32)
                    });
                    powers.product()
                }
                _ => 1.0,
            };
        }
        let all = roots.iter().map(|root| counts[root.index()]);
        all.fold(0.0, f64::max)
    }

    /// Whether something in the expression is kept whole.
    pub fn holds_group(&self, e: ExprId) -> bool {
        let reachable = self.iter_reachable(&[e]);
        (reachable.iter()).any(|&e| matches!(self.node(e), Node::Group(_)))
    }
}
