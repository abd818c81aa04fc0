//! The cheapest of some forms of equal value: as built, multiplied out, and both with common factors taken out.

use super::{ExprId, Node, Pool};

/// Sub-expressions looked at by one call of `simplify`; beyond it, forms stay as built.
const WORK_BUDGET: usize = 400_000;

impl Pool {
    /// The cheapest of the forms tried, for each sub-expression from the leaves up: as is, expanded with
    /// sin² + cos² = 1, common factors taken out. Of equally cheap forms the first.
    pub fn simplify(&mut self, e: ExprId) -> ExprId {
        let mut known = std::mem::take(&mut self.simplified);
        let mut work = 0;
        let never = |_: &Pool, _| false;
        let simplified = self.ascend(e, &mut known, never, |pool, e, known| {
            let e = pool.with_children(e, known);
            if work > WORK_BUDGET {
                e
            } else {
                pool.cheapest(e, &mut work)
            }
        });
        let mut simple = simplified.unwrap_or(e);
        // Parts that became cheaper alone can have shared more before.
        if simple != e && self.operations(&[simple]) >= self.operations(&[e]) {
            simple = e;
            known.insert(e, simple);
        }
        known.insert(simple, simple);
        self.simplified = known;
        simple
    }

    /// The cheapest form of an expression whose sub-expressions are simplified.
    fn cheapest(&mut self, e: ExprId, work: &mut usize) -> ExprId {
        let worthwhile = match self.node(e) {
            Node::Sum { constant, terms } => terms.len() + usize::from(!constant.is_zero()) > 1,
            Node::Product(factors) => factors
                .iter()
                .any(|&(base, _)| matches!(self.node(base), Node::Sum { .. })),
            _ => false,
        };
        if !worthwhile {
            return e;
        }
        let factored = self.factor(e);
        let expanded = self.expand(e);
        let both = self.factor(expanded);
        let mut best = e;
        let mut least = self.operations(&[e]);
        *work += 4 * least;
        for (i, form) in [factored, expanded, both].into_iter().enumerate() {
            if form != best && ![e, factored, expanded][..=i].contains(&form) {
                let cost = self.operations(&[form]);
                if cost < least {
                    (best, least) = (form, cost);
                }
            }
        }
        best
    }
}
