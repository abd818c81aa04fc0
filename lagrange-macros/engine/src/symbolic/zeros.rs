//! Expressions with simple zeros: those of (x − a)³ are those of x − a, where they have a slope, which tells them exactly.

use super::{ExprId, Node, Pool, Rational};

impl Pool {
    /// What has the zeros of e, and its sign if `signed`, without powers in which it vanishes more than once: a positive odd power is as its
    /// base, and so is an even one but for its sign.
    pub fn with_simple_zeros(&mut self, e: ExprId, signed: bool) -> ExprId {
        let (core, coefficient) = match self.node(e) {
            Node::Sum { constant, terms } if constant.is_zero() && terms.len() == 1 => terms[0],
            _ => (e, Rational::ONE),
        };
        let Node::Product(factors) = self.node(core) else {
            return e;
        };
        let simple = |exponent: Rational| match exponent.to_integer() {
            Some(n) if n > 1 && !(signed && n % 2 == 0) => Rational::ONE,
            _ => exponent,
        };
        let factors: Vec<_> = factors.iter().map(|&(e, r)| (e, simple(r))).collect();
        self.monomial(coefficient, &factors)
    }
}
