//! The cheapest of some forms of equal value: as built, multiplied out, with functions of sums of angles for products
//! or the other way round; each with common factors taken out.

use super::{ExprId, Node, Pool};

/// Digits that a form loses count as so many operations.
const DIGITS: usize = 6;

/// Terms and nodes looked at by one call of `simplify`; beyond it, forms stay as built. Some seconds, unoptimised.
const CALL_BUDGET: u64 = 1_000_000;

/// The same for all calls.
const POOL_BUDGET: u64 = 40_000_000;

impl Pool {
    /// The cheapest of the forms tried, for each sub-expression from the leaves up: as is, expanded with
    /// sin² + cos² = 1, with sums of angles, common factors taken out. Of equally cheap forms the first.
    pub fn simplify(&mut self, e: ExprId) -> ExprId {
        let mut known = std::mem::take(&mut self.simplified);
        let limit = POOL_BUDGET.min(self.effort + CALL_BUDGET);
        let never = |_: &Pool, _| false;
        let kept = self.squares_under_roots(e);
        let simplified = self.ascend(e, &mut known, never, |pool, e, known| {
            let digits = match kept.is_empty() {
                true => Digits::Any,
                false if kept.contains(&e) => Digits::OfSquares,
                false => Digits::OfRoots,
            };
            let e = pool.with_children(e, known);
            if pool.effort > limit || pool.is_full() {
                e
            } else {
                pool.cheapest(e, digits)
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
    fn cheapest(&mut self, e: ExprId, digits: Digits) -> ExprId {
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
        let mut choice = Choice {
            form: e,
            digits,
            cost: self.operations(&[e]) + self.cost_of_digits(e, digits),
            seen: vec![e],
        };
        for flat in self.flat_forms(e) {
            self.consider(flat, &mut choice);
            // Taking factors out leaves all additions.
            if self.has_fixed() || self.additions(flat) < choice.cost {
                let factored = self.factor(flat);
                self.consider(factored, &mut choice);
                if self.has_fixed() {
                    let collected = self.collect_varying(flat);
                    self.consider(collected, &mut choice);
                }
            }
        }
        choice.form
    }

    /// Different forms of equal value without common factors taken out, e first.
    fn flat_forms(&mut self, e: ExprId) -> Vec<ExprId> {
        let expanded = self.expand(e);
        let mut flat = vec![e, expanded, self.contract_angles(expanded)];
        let split = self.split_angles(expanded);
        if split != expanded {
            flat.push(split);
            flat.push(self.contract_angles(split));
        }
        let mut distinct: Vec<ExprId> = Vec::with_capacity(flat.len());
        for form in flat {
            if !distinct.contains(&form) {
                distinct.push(form);
            }
        }
        distinct
    }

    /// Takes the form if it is cheaper.
    fn consider(&mut self, form: ExprId, choice: &mut Choice) {
        if choice.seen.contains(&form) {
            return;
        }
        choice.seen.push(form);
        let cost = self.operations(&[form]);
        self.effort += cost as u64;
        if cost > choice.cost {
            return;
        }
        let cost = cost + self.cost_of_digits(form, choice.digits);
        if cost < choice.cost || (cost == choice.cost && self.needs_less_once(form, choice.form)) {
            (choice.form, choice.cost) = (form, cost);
        }
    }

    /// What the digits that a form loses count as.
    fn cost_of_digits(&self, form: ExprId, digits: Digits) -> usize {
        DIGITS
            * match digits {
                Digits::Any => 0,
                Digits::OfRoots => self.losses(form),
                Digits::OfSquares => self.losses(form) + usize::from(!self.is_sum_of_squares(form)),
            }
    }

    /// Additions of a sum itself.
    fn additions(&self, e: ExprId) -> usize {
        match self.node(e) {
            Node::Sum { constant, terms } => terms.len() - usize::from(constant.is_zero()),
            _ => 0,
        }
    }

    /// Whether a form is cheaper in what is computed once, for forms that are equally cheap in a run.
    fn needs_less_once(&self, form: ExprId, than: ExprId) -> bool {
        self.has_fixed() && self.all_operations(form) < self.all_operations(than)
    }
}

/// Which digits matter.
#[derive(Clone, Copy)]
enum Digits {
    /// None does more than others.
    Any,
    /// Those of what stands under roots.
    OfRoots,
    /// Those of this expression as well, which stands there itself and is a sum of squares.
    OfSquares,
}

/// The cheapest form so far.
struct Choice {
    form: ExprId,
    digits: Digits,
    /// Operations, and digits lost.
    cost: usize,
    /// What has been looked at.
    seen: Vec<ExprId>,
}
