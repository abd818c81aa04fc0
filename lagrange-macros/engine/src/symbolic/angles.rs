//! Sums and differences of angles, in both directions:
//!
//! ```text
//! cos a cos b ∓ sin a sin b = cos(a ± b)        sin a cos b ± cos a sin b = sin(a ± b)
//! ```
//!
//! Contracting makes what positions x = Σ l sin θ give into the textbook's cos(θ₁ − θ₂); splitting lets such forms
//! cancel against products.

use super::{ExprId, Function, Node, Pool, Rational};

/// Longer sums are not searched.
const MOST_TERMS: usize = 512;

/// Products with more sines and cosines are not searched.
const MOST_CIRCULAR: usize = 8;

/// Factors of one term that are split; each doubles the number of terms.
const MOST_SPLITS: Rational = Rational::integer(3);

/// One way to see a product as X · f(a) · g(b), a < b.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Pair {
    /// X
    rest: ExprId,
    a: ExprId,
    b: ExprId,
    /// Size of the coefficient.
    size: Rational,
    /// f and g are of different kinds.
    mixed: bool,
    /// f is the cosine.
    cosine: bool,
    /// The coefficient is negative.
    negative: bool,
    /// ValueRef of the term.
    term: usize,
}

impl Pool {
    /// A sum with pairs of its terms contracted to functions of a sum or difference; anything else as it is.
    pub(super) fn contract_angles(&mut self, e: ExprId) -> ExprId {
        let mut e = e;
        // Each round leaves fewer terms.
        loop {
            let Node::Sum { constant, terms } = self.node(e) else {
                return e;
            };
            let (constant, mut terms) = (*constant, terms.clone());
            if terms.len() > MOST_TERMS {
                return e;
            }
            let mut pairs = Vec::new();
            for (i, &(term, c)) in terms.iter().enumerate() {
                self.pairs_of(term, c, i, &mut pairs);
            }
            pairs.sort_unstable();
            let mut new = Vec::new();
            for two in pairs.windows(2) {
                let key = |pair: &Pair| (pair.rest, pair.a, pair.b, pair.size, pair.mixed);
                let spent = terms[two[0].term].1.is_zero() || terms[two[1].term].1.is_zero();
                if key(&two[0]) == key(&two[1]) && two[0].cosine != two[1].cosine && !spent {
                    new.push(self.contracted(two[0], two[1]));
                    terms[two[0].term].1 = Rational::ZERO;
                    terms[two[1].term].1 = Rational::ZERO;
                }
            }
            if new.is_empty() {
                return e;
            }
            terms.extend(new);
            e = self.linear(constant, terms);
        }
    }

    /// Sine first in f(a), then cosine first: one function of a ± b as (expression, number).
    fn contracted(&mut self, sine: Pair, cosine: Pair) -> (ExprId, Rational) {
        let opposite = sine.negative != cosine.negative;
        // sin a cos b ± cos a sin b, and cos a cos b ∓ sin a sin b.
        let plus = opposite != sine.mixed;
        let sign = |negative| {
            if negative {
                Rational::MINUS_ONE
            } else {
                Rational::ONE
            }
        };
        let angle = self.linear(
            Rational::ZERO,
            vec![(sine.a, Rational::ONE), (sine.b, sign(!plus))],
        );
        let (f, negative) = if sine.mixed {
            (Function::Sin, sine.negative)
        } else {
            (Function::Cos, cosine.negative)
        };
        let value = self.call(f, &[angle]);
        let size = if negative {
            self.negative(sine.size)
        } else {
            sine.size
        };
        let (c, core) =
            self.monomial_parts(size, &[(sine.rest, Rational::ONE), (value, Rational::ONE)]);
        (core, c)
    }

    /// All ways to see a term with two of sin and cos.
    fn pairs_of(&mut self, term: ExprId, c: Rational, place: usize, pairs: &mut Vec<Pair>) {
        let Node::Product(factors) = self.node(term) else {
            return;
        };
        let mut circular: Vec<(usize, ExprId, bool)> = Vec::new();
        for (i, &(base, exponent)) in factors.iter().enumerate() {
            if exponent.is_integer() && !exponent.is_negative() {
                match self.node(base) {
                    Node::Call(Function::Sin, u) => circular.push((i, u[0], false)),
                    Node::Call(Function::Cos, u) => circular.push((i, u[0], true)),
                    _ => {}
                }
            }
        }
        if circular.len() < 2 || circular.len() > MOST_CIRCULAR {
            return;
        }
        let factors = factors.clone();
        let size = self.checked(c.checked_abs());
        for (n, &first) in circular.iter().enumerate() {
            for &second in &circular[n + 1..] {
                let (f, g) = if first.1 < second.1 {
                    (first, second)
                } else {
                    (second, first)
                };
                if f.1 == g.1 {
                    continue;
                }
                let mut rest = factors.clone();
                for i in [f.0, g.0] {
                    rest[i].1 = self.plus(rest[i].1, Rational::MINUS_ONE);
                }
                let rest = self.monomial(Rational::ONE, &rest);
                self.effort += 1;
                pairs.push(Pair {
                    rest,
                    a: f.1,
                    b: g.1,
                    size,
                    mixed: f.2 != g.2,
                    cosine: f.2,
                    negative: c.is_negative(),
                    term: place,
                });
            }
        }
    }

    /// A sum (or product) with sin and cos of sums of two terms as products, multiplied out; anything else, and terms
    /// with many such factors, as they are.
    pub(super) fn split_angles(&mut self, e: ExprId) -> ExprId {
        let (constant, terms) = match self.node(e) {
            Node::Sum { constant, terms } => (*constant, terms.clone()),
            _ => (Rational::ZERO, vec![(e, Rational::ONE)]),
        };
        if terms.len() > MOST_TERMS {
            return e;
        }
        let mut new = terms.clone();
        for term in &mut new {
            term.0 = self.split_term(term.0);
        }
        if new == terms {
            return e;
        }
        let e = self.linear(constant, new);
        self.expand(e)
    }

    fn split_term(&mut self, term: ExprId) -> ExprId {
        let mut factors = match self.node(term) {
            Node::Product(factors) => factors.clone(),
            _ => vec![(term, Rational::ONE)],
        };
        let mut degree = Rational::ZERO;
        for factor in &mut factors {
            if factor.1.is_integer()
                && !factor.1.is_negative()
                && let Some(split) = self.split_call(factor.0)
            {
                degree = self.plus(degree, factor.1);
                factor.0 = split;
            }
        }
        if degree.is_zero() || degree > MOST_SPLITS {
            term
        } else {
            self.monomial(Rational::ONE, &factors)
        }
    }

    fn split_call(&mut self, e: ExprId) -> Option<ExprId> {
        let (cosine, argument) = match self.node(e) {
            Node::Call(Function::Sin, u) => (false, u[0]),
            Node::Call(Function::Cos, u) => (true, u[0]),
            _ => return None,
        };
        let Node::Sum { constant, terms } = self.node(argument) else {
            return None;
        };
        let (constant, terms) = (*constant, terms.clone());
        let [a, b] = match (&terms[..], constant.is_zero()) {
            (&[(a, m), (b, n)], true) => [self.scale(a, m), self.scale(b, n)],
            (&[(a, m)], false) => [self.scale(a, m), self.number(constant)],
            _ => return None,
        };
        let [sa, ca, sb, cb] = [
            (Function::Sin, a),
            (Function::Cos, a),
            (Function::Sin, b),
            (Function::Cos, b),
        ]
        .map(|(f, u)| self.call(f, &[u]));
        Some(if cosine {
            let (left, right) = (self.mul(ca, cb), self.mul(sa, sb));
            self.sub(left, right)
        } else {
            let (left, right) = (self.mul(sa, cb), self.mul(ca, sb));
            self.add(left, right)
        })
    }
}
