//! Common factors taken out of a sum: what all terms share, then greedily what most terms share (Horner's form).

use super::{ExprId, Node, Pool, Rational};

/// Longer sums are not searched.
const LONGEST: usize = 1024;

/// c · Π baseᵢ^exponentᵢ
struct Term {
    coefficient: Rational,
    factors: Vec<(ExprId, Rational)>,
}

impl Pool {
    /// A sum with common factors taken out; anything else as it is.
    pub fn factor(&mut self, e: ExprId) -> ExprId {
        let Node::Sum { constant, terms } = self.node(e) else {
            return e;
        };
        if terms.len() > LONGEST {
            return e;
        }
        let constant = *constant;
        let mut list = Vec::with_capacity(terms.len() + 1);
        for &(term, coefficient) in terms {
            let factors = match self.node(term) {
                Node::Product(factors) => factors.clone(),
                _ => vec![(term, Rational::ONE)],
            };
            list.push(Term {
                coefficient,
                factors,
            });
        }
        if !constant.is_zero() {
            list.push(Term {
                coefficient: constant,
                factors: Vec::new(),
            });
        }
        self.factor_terms(list)
    }

    fn factor_terms(&mut self, terms: Vec<Term>) -> ExprId {
        let mut terms = terms;
        if terms.len() == 1 {
            return self.monomial(terms[0].coefficient, &terms[0].factors);
        }
        let common = self.take_common(&mut terms);
        if !common.is_empty() {
            let rest = self.factor_terms(terms);
            let mut factors = common;
            factors.push((rest, Rational::ONE));
            return self.monomial(Rational::ONE, &factors);
        }
        let mut parts = Vec::new();
        while let Some((base, negative)) = most_frequent(&terms) {
            let holds = |term: &Term| {
                exponent_of(term, base).is_some_and(|exponent| exponent.is_negative() == negative)
            };
            let (group, rest): (Vec<Term>, Vec<Term>) = terms.into_iter().partition(holds);
            terms = rest;
            parts.push((self.factor_terms(group), Rational::ONE));
        }
        for term in terms {
            let (c, core) = self.monomial_parts(term.coefficient, &term.factors);
            parts.push((core, c));
        }
        self.linear(Rational::ZERO, parts)
    }

    /// Divides all terms by their greatest common monomial, and returns it.
    fn take_common(&mut self, terms: &mut [Term]) -> Vec<(ExprId, Rational)> {
        let mut common = Vec::new();
        for &(base, first) in &terms[0].factors {
            let mut least = first;
            let shared = terms[1..].iter().all(|term| {
                exponent_of(term, base).is_some_and(|exponent| {
                    least = least.min(exponent);
                    exponent.is_negative() == first.is_negative()
                })
            });
            if shared {
                common.push((base, least));
            }
        }
        for &(base, exponent) in &common {
            let inverse = self.negative(exponent);
            for term in terms.iter_mut() {
                if let Some(factor) = term.factors.iter_mut().find(|(b, _)| *b == base) {
                    factor.1 = self.plus(factor.1, inverse);
                }
                term.factors.retain(|(_, exponent)| !exponent.is_zero());
            }
        }
        common
    }
}

fn exponent_of(term: &Term, base: ExprId) -> Option<Rational> {
    let at = term.factors.binary_search_by_key(&base, |&(b, _)| b).ok()?;
    Some(term.factors[at].1)
}

/// The base (with the sign of its exponent) that most terms share, at least two; of equals the first.
fn most_frequent(terms: &[Term]) -> Option<(ExprId, bool)> {
    let mut bases: Vec<(ExprId, bool)> = terms
        .iter()
        .flat_map(|term| {
            term.factors
                .iter()
                .map(|&(base, exponent)| (base, exponent.is_negative()))
        })
        .collect();
    bases.sort();
    let (mut best, mut most, mut at) = (None, 1, 0);
    while at < bases.len() {
        let count = bases[at..]
            .iter()
            .take_while(|&&base| base == bases[at])
            .count();
        if count > most {
            (best, most) = (Some(bases[at]), count);
        }
        at += count;
    }
    best
}
