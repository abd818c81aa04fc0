//! The cheapest of some forms of equal value: as built, multiplied out, with functions of sums of angles for products
//! or the other way round; each with common factors taken out.

use super::{ExprId, Node, Pool};

/// Sub-expressions looked at by one call of `simplify`; beyond it, forms stay as built.
const WORK_BUDGET: usize = 400_000;

impl Pool {
    /// The cheapest of the forms tried, for each sub-expression from the leaves up: as is, expanded with
    /// sin² + cos² = 1, with sums of angles, common factors taken out. Of equally cheap forms the first.
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
        let (before, after) = (self.operations(&[e]), self.operations(&[simple]));
        if simple != e && (after > before || (after == before && !self.needs_less_once(simple, e)))
        {
            simple = e;
            known.set(e, simple);
        }
        known.set(simple, simple);
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
        let forms = self.forms(e);
        let (mut best, mut least) = (e, self.operations(&[e]));
        for i in 1..forms.len() {
            if !forms[..i].contains(&forms[i]) {
                let cost = self.operations(&[forms[i]]);
                if cost < least || (cost == least && self.needs_less_once(forms[i], best)) {
                    (best, least) = (forms[i], cost);
                }
            }
        }
        *work += forms.len() * (1 + least);
        best
    }

    /// Forms of equal value, e first.
    fn forms(&mut self, e: ExprId) -> Vec<ExprId> {
        let expanded = self.expand(e);
        let mut flat = vec![e, expanded];
        let contracted = self.contract_angles(expanded);
        flat.push(contracted);
        if self.has_angle_sum(expanded) {
            let split = self.split_angles(expanded);
            let split = self.expand(split);
            flat.push(split);
            flat.push(self.contract_angles(split));
        }
        let mut forms: Vec<ExprId> = Vec::with_capacity(3 * flat.len());
        for i in 0..flat.len() {
            if flat[..i].contains(&flat[i]) {
                continue;
            }
            forms.push(flat[i]);
            forms.push(self.factor(flat[i]));
            if self.has_fixed() {
                forms.push(self.collect_varying(flat[i]));
            }
        }
        forms
    }

    /// Whether a form is cheaper in what is computed once, for forms that are equally cheap in a run.
    fn needs_less_once(&self, form: ExprId, than: ExprId) -> bool {
        self.has_fixed() && self.all_operations(form) < self.all_operations(than)
    }
}
