//! Products over sums, and positive integer powers of sums, multiplied out; sums then collect what cancels.

use super::{ExprId, Node, Pool, Rational};

/// A product that would give more terms stays as it is.
const TERM_BUDGET: u128 = 2048;

impl Pool {
    /// Products over sums multiplied out, also inside functions and roots (within a term budget, else unchanged).
    pub fn expand(&mut self, e: ExprId) -> ExprId {
        let mut known = std::mem::take(&mut self.expanded);
        let never = |_: &Pool, _| false;
        let expanded = self.ascend(e, &mut known, never, |pool, e, known| {
            let e = pool.with_children(e, known);
            pool.multiply_out(e)
        });
        self.expanded = known;
        expanded.unwrap_or(e)
    }

    /// Multiplies out the terms of an expression whose sub-expressions are expanded.
    fn multiply_out(&mut self, e: ExprId) -> ExprId {
        match self.node(e) {
            Node::Product(_) => self.multiply_out_product(e),
            Node::Sum { constant, terms } => {
                if !terms.iter().any(|&(term, _)| self.is_expandable(term)) {
                    return e;
                }
                let (constant, mut terms) = (*constant, terms.clone());
                for term in &mut terms {
                    term.0 = self.multiply_out_product(term.0);
                }
                self.linear(constant, terms)
            }
            _ => e,
        }
    }

    /// A product with a sum to a positive integer power.
    fn is_expandable(&self, e: ExprId) -> bool {
        let Node::Product(factors) = self.node(e) else {
            return false;
        };
        factors
            .iter()
            .any(|&(base, exponent)| self.is_power_of_sum(base, exponent))
    }

    fn is_power_of_sum(&self, base: ExprId, exponent: Rational) -> bool {
        exponent.is_integer()
            && !exponent.is_negative()
            && matches!(self.node(base), Node::Sum { .. })
    }

    fn multiply_out_product(&mut self, e: ExprId) -> ExprId {
        let Node::Product(factors) = self.node(e) else {
            return e;
        };
        if self.is_full() {
            return e;
        }
        let (sums, rest): (Vec<_>, Vec<_>) = factors
            .iter()
            .partition(|&&(base, exponent)| self.is_power_of_sum(base, exponent));
        if sums.is_empty() {
            return e;
        }
        let mut count: u128 = 1;
        for &(base, exponent) in &sums {
            count = count.saturating_mul(power_terms(self.parts(base), exponent));
        }
        if count > TERM_BUDGET {
            return e;
        }
        let mut product = self.monomial(Rational::ONE, &rest);
        for (base, exponent) in sums {
            let power = self.expanded_power(base, exponent.numerator());
            product = self.expanded_product(product, power);
        }
        product
    }

    /// Number of terms of a sum, the constant included.
    fn parts(&self, e: ExprId) -> u128 {
        match self.node(e) {
            Node::Sum { constant, terms } => terms.len() as u128 + u128::from(!constant.is_zero()),
            _ => 1,
        }
    }

    /// e as a list of terms; the constant is the term 1.
    fn terms(&mut self, e: ExprId) -> Vec<(ExprId, Rational)> {
        let Node::Sum { constant, terms } = self.node(e) else {
            return vec![(e, Rational::ONE)];
        };
        let (constant, mut terms) = (*constant, terms.clone());
        if !constant.is_zero() {
            terms.push((self.integer(1), constant));
        }
        terms
    }

    fn expanded_power(&mut self, e: ExprId, n: i128) -> ExprId {
        if n == 1 {
            return e;
        }
        let half = self.expanded_power(e, n / 2);
        let square = self.expanded_square(half);
        if n % 2 == 1 {
            self.expanded_product(square, e)
        } else {
            square
        }
    }

    fn expanded_square(&mut self, e: ExprId) -> ExprId {
        let terms = self.terms(e);
        let mut products = Vec::with_capacity(terms.len() * (terms.len() + 1) / 2);
        for (i, &a) in terms.iter().enumerate() {
            for (j, &b) in terms[..=i].iter().enumerate() {
                let twice = Rational::integer(if i == j { 1 } else { 2 });
                self.push_product(&mut products, twice, a, b);
            }
        }
        self.linear(Rational::ZERO, products)
    }

    fn expanded_product(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let (left, right) = (self.terms(a), self.terms(b));
        let mut products = Vec::with_capacity(left.len() * right.len());
        for &a in &left {
            for &b in &right {
                self.push_product(&mut products, Rational::ONE, a, b);
            }
        }
        self.linear(Rational::ZERO, products)
    }

    fn push_product(
        &mut self,
        to: &mut Vec<(ExprId, Rational)>,
        c: Rational,
        a: (ExprId, Rational),
        b: (ExprId, Rational),
    ) {
        self.effort += 1;
        let c = self.times(a.1, c);
        let c = self.times(c, b.1);
        let factors = [(a.0, Rational::ONE), (b.0, Rational::ONE)];
        let (c, core) = self.monomial_parts(c, &factors);
        // Roots can have met: √u · √u·x = u·x with a sum u.
        let core = if self.is_expandable(core) {
            self.multiply_out_product(core)
        } else {
            core
        };
        to.push((core, c));
    }
}

/// Terms of a sum of k terms to the power n, before cancellation: C(n+k−1, n).
fn power_terms(k: u128, exponent: Rational) -> u128 {
    let mut count: u128 = 1;
    for i in 0..exponent.numerator().unsigned_abs() {
        count = count.saturating_mul(k + i) / (i + 1);
        if count > TERM_BUDGET {
            break;
        }
    }
    count
}
