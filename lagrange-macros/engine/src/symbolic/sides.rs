//! Powers of what is chosen: max(0, d)^p is 0 on one side, and d^p on the other.

use super::table::Table;
use super::{ExprId, Node, Pool, Rational};
use crate::sorted::SortedMap;

impl Pool {
    /// Expressions in which no power above one, and of no whole number, is of what is zero on one side of a branch: what is chosen is raised where it is.
    /// A power of zero has a value, and no Taylor series that could begin.
    pub fn raise_sides(&mut self, roots: &[ExprId]) -> Vec<ExprId> {
        let reachable = self.iter_reachable(roots);
        let is_chosen = |base: ExprId| self.holds_selection(base);
        if !reachable
            .iter()
            .any(|&e| self.begun(e).into_iter().any(is_chosen))
        {
            return roots.to_vec();
        }
        let mut known = Table::default();
        let whole = |pool: &Pool, e| !pool.holds_selection(e);
        let raise = |&root: &ExprId| {
            let raised = self.ascend(root, &mut known, whole, |pool, e, known| {
                let e = pool.with_children(e, known);
                pool.raised(e)
            });
            raised.unwrap_or(root)
        };
        roots.iter().map(raise).collect()
    }

    /// What begins in a product where it is zero, and has no Taylor series there: its powers together are above one, and of no whole number. It is d in
    /// d^(3/2), (k d)^(3/2), √(d³) and d √(k d).
    pub fn begun(&self, e: ExprId) -> Vec<ExprId> {
        let Node::Product(factors) = self.node(e) else {
            return Vec::new();
        };
        if factors.iter().all(|(_, p)| p.is_integer()) {
            return Vec::new();
        }
        let mut powers: SortedMap<ExprId, Option<Rational>> = SortedMap::new();
        let mut multiply = |base: ExprId, p: Option<Rational>| {
            let power = powers.get_or_insert(base, Some(Rational::ZERO));
            *power = power.zip(p).and_then(|(power, p)| power.checked_add(p));
        };
        for &(base, p) in factors {
            let core = self.unsigned(base);
            match self.node(core) {
                Node::Product(inner) => {
                    for &(base, q) in inner {
                        multiply(base, q.checked_mul(p));
                    }
                }
                _ => multiply(core, Some(p)),
            }
        }
        let begins = |p: Rational| p > Rational::ONE && !p.is_integer();
        let begun = powers.iter().filter(|(_, p)| p.is_some_and(begins));
        begun.map(|(&base, _)| base).collect()
    }

    /// A base without its sign, or its number: what it is called in the product of itself and a root of its opposite.
    fn unsigned(&self, base: ExprId) -> ExprId {
        let Node::Sum { constant, terms } = self.node(base) else {
            return base;
        };
        if constant.is_zero() && terms.len() == 1 {
            return terms[0].0;
        }
        let opposite = |terms: &[(ExprId, Rational)]| {
            let negative = |&(e, c): &(ExprId, Rational)| Some((e, c.checked_neg()?));
            Some(Node::Sum {
                constant: constant.checked_neg()?,
                terms: terms.iter().map(negative).collect::<Option<_>>()?,
            })
        };
        match opposite(terms) {
            Some(opposite) if self.leads_negative(base) => self.find(&opposite).unwrap_or(base),
            _ => base,
        }
    }

    /// A product as a choice of products, where a power of what is zero on one side of a branch is in it.
    fn raised(&mut self, e: ExprId) -> ExprId {
        for base in self.begun(e) {
            for branch in self.branches(base) {
                let sides = [true, false].map(|first| self.on_side(base, branch, first));
                let Node::Product(factors) = self.node(e) else {
                    return e;
                };
                if !sides.iter().any(|&side| self.is_zero(side)) {
                    continue;
                }
                let is_decided =
                    |&(base, _): &(ExprId, Rational)| self.branches(base).contains(&branch);
                let (decided, rest): (Vec<_>, Vec<_>) =
                    factors.clone().into_iter().partition(is_decided);
                let [decided, rest] =
                    [decided, rest].map(|part| self.monomial(Rational::ONE, &part));
                let sides = [true, false].map(|first| self.on_side(decided, branch, first));
                let sides = self.raise_sides(&sides);
                let (chosen, rest) = (self.select(branch, sides[0], sides[1]), self.raised(rest));
                return self.mul(rest, chosen);
            }
        }
        e
    }

    /// What an expression is on one side of a branch, the first or the second.
    pub fn on_side(&mut self, e: ExprId, branch: usize, first: bool) -> ExprId {
        let whole = |pool: &Pool, e| !pool.holds_selection(e);
        let side = self.ascend(e, &mut Table::default(), whole, |pool, e, known| {
            let e = pool.with_children(e, known);
            match *pool.node(e) {
                Node::Select {
                    branch: this,
                    then,
                    otherwise,
                } if this == branch => [otherwise, then][usize::from(first)],
                _ => e,
            }
        });
        side.unwrap_or(e)
    }
}
