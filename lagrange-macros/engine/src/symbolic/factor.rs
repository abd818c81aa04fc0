//! Common factors taken out of a sum: what all terms share, then greedily what most terms share (Horner's form).

use super::table::Words;
use super::{ExprId, Node, Pool, Rational};

/// Longer sums are not searched.
const LONGEST: usize = 1024;

/// c · Π base^exponent
struct Term {
    coefficient: Rational,
    /// (place of the base in the search, exponent), ascending.
    factors: Vec<(usize, Rational)>,
}

/// The bases of the terms of one sum.
struct Search {
    bases: Vec<ExprId>,
    /// Whether a base may split the sum in two; a base that all terms share is always taken out.
    splits: Vec<bool>,
}

impl Pool {
    /// A sum with common factors taken out; anything else as it is.
    pub fn factor(&mut self, e: ExprId) -> ExprId {
        match self.search(e) {
            Some((mut search, terms)) => self.factor_terms(&mut search, terms),
            None => e,
        }
    }

    /// A sum as Σ fixed coefficient · varying product, each product once, with common varying factors taken out;
    /// anything else as it is.
    pub(super) fn collect_varying(&mut self, e: ExprId) -> ExprId {
        let Some((mut search, terms)) = self.search(e) else {
            return e;
        };
        let varies: Vec<bool> = search.bases.iter().map(|&base| self.varies(base)).collect();
        let mut parts = Vec::with_capacity(terms.len());
        for term in terms {
            let (varying, fixed): (Vec<_>, Vec<_>) = term
                .factors
                .into_iter()
                .partition(|&(base, _)| varies[base]);
            parts.push((varying, term.coefficient, fixed));
        }
        parts.sort();
        search.splits = varies;
        let mut terms = Vec::new();
        let mut rest = parts.into_iter().peekable();
        while let Some((varying, coefficient, fixed)) = rest.next() {
            let mut group = vec![Term {
                coefficient,
                factors: fixed,
            }];
            while let Some((_, coefficient, fixed)) = rest.next_if(|part| part.0 == varying) {
                group.push(Term {
                    coefficient,
                    factors: fixed,
                });
            }
            let mut term = Term {
                coefficient: Rational::ONE,
                factors: varying,
            };
            match <[Term; 1]>::try_from(group) {
                Ok([one]) => {
                    term.coefficient = one.coefficient;
                    term.factors.extend(one.factors);
                    term.factors.sort();
                }
                Err(group) => {
                    let list = group
                        .iter()
                        .map(|term| self.multiplied(&search, term))
                        .collect();
                    let fixed = self.linear(Rational::ZERO, list);
                    let fixed = self.factor(fixed);
                    term.factors.push((search.bases.len(), Rational::ONE));
                    search.bases.push(fixed);
                    search.splits.push(false);
                }
            }
            terms.push(term);
        }
        self.factor_terms(&mut search, terms)
    }

    /// The terms of a sum by their bases.
    fn search(&self, e: ExprId) -> Option<(Search, Vec<Term>)> {
        let Node::Sum { constant, terms } = self.node(e) else {
            return None;
        };
        if terms.len() > LONGEST {
            return None;
        }
        let mut places = Words::<{ u32::MAX }>::default();
        let mut bases = Vec::new();
        let mut note = |base: ExprId| {
            if places.get(base) == u32::MAX {
                places.set(base, 0);
                bases.push(base);
            }
        };
        for &(term, _) in terms {
            match self.node(term) {
                Node::Product(factors) => {
                    for &(base, _) in factors {
                        note(base);
                    }
                }
                _ => note(term),
            }
        }
        bases.sort_unstable();
        for (place, &base) in bases.iter().enumerate() {
            places.set(base, place as u32);
        }
        let place = |base: ExprId| places.get(base) as usize;
        let mut list = Vec::with_capacity(terms.len() + 1);
        for &(term, coefficient) in terms {
            let factors = match self.node(term) {
                Node::Product(factors) => factors
                    .iter()
                    .map(|&(base, exponent)| (place(base), exponent))
                    .collect(),
                _ => vec![(place(term), Rational::ONE)],
            };
            list.push(Term {
                coefficient,
                factors,
            });
        }
        if !constant.is_zero() {
            list.push(Term {
                coefficient: *constant,
                factors: Vec::new(),
            });
        }
        let splits = vec![true; bases.len()];
        Some((Search { bases, splits }, list))
    }

    /// A term as (expression, number).
    fn multiplied(&mut self, search: &Search, term: &Term) -> (ExprId, Rational) {
        let factors: Vec<_> = term
            .factors
            .iter()
            .map(|&(base, exponent)| (search.bases[base], exponent))
            .collect();
        let (c, core) = self.monomial_parts(term.coefficient, &factors);
        (core, c)
    }

    fn factor_terms(&mut self, search: &mut Search, terms: Vec<Term>) -> ExprId {
        let mut terms = terms;
        self.effort += terms.len() as u64;
        if terms.len() > 1 {
            let mut common = self.take_common(&mut terms);
            if !common.is_empty() {
                let rest = self.factor_terms(search, terms);
                search.bases.push(rest);
                search.splits.push(false);
                common.push((search.bases.len() - 1, Rational::ONE));
                let (core, c) = self.multiplied(
                    search,
                    &Term {
                        coefficient: Rational::ONE,
                        factors: common,
                    },
                );
                return self.scale(core, c);
            }
        }
        let mut parts = Vec::new();
        while let Some((base, negative)) = search.most_frequent(&terms) {
            self.effort += terms.len() as u64;
            let holds =
                |term: &Term| exponent_of(term, base).is_some_and(|e| e.is_negative() == negative);
            let (group, rest): (Vec<Term>, Vec<Term>) = terms.into_iter().partition(holds);
            terms = rest;
            parts.push((self.factor_terms(search, group), Rational::ONE));
        }
        for term in &terms {
            parts.push(self.multiplied(search, term));
        }
        self.linear(Rational::ZERO, parts)
    }

    /// Divides all terms by their greatest common monomial, and returns it.
    fn take_common(&mut self, terms: &mut [Term]) -> Vec<(usize, Rational)> {
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
                for factor in &mut term.factors {
                    if factor.0 == base {
                        factor.1 = self.plus(factor.1, inverse);
                    }
                }
                term.factors.retain(|(_, exponent)| !exponent.is_zero());
            }
        }
        common
    }
}

impl Search {
    /// The base (with the sign of its exponent) that most terms share, at least two; of equals the first.
    fn most_frequent(&self, terms: &[Term]) -> Option<(usize, bool)> {
        let mut counts = vec![0; 2 * self.bases.len()];
        let (mut best, mut most) = (usize::MAX, 1);
        for term in terms {
            for &(base, exponent) in &term.factors {
                if self.splits[base] {
                    let key = 2 * base + usize::from(exponent.is_negative());
                    counts[key] += 1;
                    if counts[key] > most || (counts[key] == most && key < best) {
                        (best, most) = (key, counts[key]);
                    }
                }
            }
        }
        (most > 1).then_some((best / 2, best % 2 == 1))
    }
}

fn exponent_of(term: &Term, base: usize) -> Option<Rational> {
    term.factors
        .iter()
        .find(|&&(b, _)| b == base)
        .map(|&(_, exponent)| exponent)
}
