//! Other forms of a sum: products multiplied out, and terms that share factors put together.

use super::{Factors, Reader};
use crate::inspect::names::Kind;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Rational};

/// Sums that would have more terms are not multiplied out.
const MOST_EXPANDED: usize = 48;

impl Reader<'_> {
    /// Whether a factor is a sum that moves, which can be multiplied out.
    pub(super) fn opens(&self, base: ExprId, exponent: Rational) -> bool {
        exponent.is_integer()
            && !exponent.is_negative()
            && exponent.numerator() <= 3
            && matches!(self.pool.node(base), Node::Sum { .. })
            && !self.is_still(base)
    }

    /// Products over moving sums multiplied out; `None` if that is too long.
    pub fn multiplied_out(&mut self, e: ExprId) -> Option<ExprId> {
        self.multiplied_out_within(MOST_EXPANDED, e)
    }

    /// The same for a sum that would have no more than so many terms.
    pub fn multiplied_out_within(&mut self, most: usize, e: ExprId) -> Option<ExprId> {
        let mut terms = Vec::new();
        self.open(most, e, (Rational::ONE, Vec::new()), &mut terms)?;
        let mut list = Vec::new();
        for (c, factors) in terms {
            list.push((self.pool.monomial(c, &factors), Rational::ONE));
        }
        Some(self.pool.linear(Rational::ZERO, list))
    }

    /// Adds the terms of e times `by`.
    fn open(
        &self,
        most: usize,
        e: ExprId,
        by: (Rational, Factors),
        terms: &mut Vec<(Rational, Factors)>,
    ) -> Option<()> {
        if terms.len() > most {
            return None;
        }
        let (c, mut factors) = by;
        match self.pool.node(e) {
            Node::Number(n) => terms.push((c.checked_mul(*n)?, factors)),
            Node::Sum {
                constant,
                terms: own,
            } => {
                for &(term, size) in own {
                    self.open(most, term, (c.checked_mul(size)?, factors.clone()), terms)?;
                }
                if !constant.is_zero() {
                    terms.push((c.checked_mul(*constant)?, factors));
                }
            }
            Node::Product(own) => {
                let opening = own.iter().position(|&(base, r)| self.opens(base, r));
                let Some(at) = opening else {
                    factors.extend(own.iter().copied());
                    terms.push((c, factors));
                    return Some(());
                };
                let (base, exponent) = own[at];
                let mut rest = own.clone();
                match exponent.is_one() {
                    true => drop(rest.remove(at)),
                    false => rest[at].1 = exponent.checked_sub(Rational::ONE)?,
                }
                let mut inner = Vec::new();
                self.open(most, base, (c, factors), &mut inner)?;
                for (c, mut factors) in inner {
                    // What is left of the product can open in turn.
                    let mut still = Vec::new();
                    for &(base, r) in &rest {
                        match self.opens(base, r) {
                            true => still.push((base, r)),
                            false => factors.push((base, r)),
                        }
                    }
                    self.open_factors(most, &still, (c, factors), terms)?;
                }
            }
            _ => {
                factors.push((e, Rational::ONE));
                terms.push((c, factors));
            }
        }
        Some(())
    }

    /// Multiplies `by` with powers of sums.
    fn open_factors(
        &self,
        most: usize,
        sums: &[(ExprId, Rational)],
        by: (Rational, Factors),
        terms: &mut Vec<(Rational, Factors)>,
    ) -> Option<()> {
        let Some((&(base, exponent), rest)) = sums.split_first() else {
            terms.push(by);
            return (terms.len() <= most).then_some(());
        };
        let mut partial = vec![by];
        for _ in 0..exponent.numerator() {
            let mut next = Vec::new();
            for term in partial {
                self.open(most, base, term, &mut next)?;
            }
            partial = next;
        }
        for term in partial {
            self.open_factors(most, rest, term, terms)?;
        }
        Some(())
    }

    /// Terms put together that agree in all factors of this kind or a later one, functions of such included.
    pub(super) fn collected(&mut self, flat: ExprId, kind: Kind) -> ExprId {
        let Node::Sum { constant, terms } = self.pool.node(flat).clone() else {
            return flat;
        };
        let mut groups: SortedMap<Factors, Vec<(ExprId, Rational)>> = SortedMap::new();
        for (term, c) in terms {
            let (moving, still): (Factors, Factors) = self
                .factors(term)
                .into_iter()
                .partition(|&(base, _)| !self.is_below(base, kind));
            let still = self.pool.monomial(Rational::ONE, &still);
            groups.get_or_default(moving).push((still, c));
        }
        let mut terms = Vec::new();
        for (moving, group) in groups {
            let coefficient = self.pool.linear(Rational::ZERO, group);
            // What a force balances exactly is no part of what is left.
            let flat = self.pool.expand(coefficient);
            if self.pool.is_zero(flat) {
                continue;
            }
            let mut factors = moving;
            if !factors.is_empty() {
                factors.push((coefficient, Rational::ONE));
                terms.push((self.pool.monomial(Rational::ONE, &factors), Rational::ONE));
            } else {
                terms.push((coefficient, Rational::ONE));
            }
        }
        self.pool.linear(constant, terms)
    }
}
