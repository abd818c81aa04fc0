//! Products Π baseᵢ^exponentᵢ and powers: bases collected, numbers folded into one coefficient.
//!
//! x^a x^b = x^(a+b), (x^a)^n = x^(an) for integer n, and for any exponent where x^a is never negative; (√x)² = x,
//! but √(x²) stays.

use super::pool::MOST_EXPONENT;
use super::{ExprId, Function, Node, Outgrown, Pool, Rational};

/// Factors on their way into a product.
pub(super) struct Factors {
    pub(super) coefficient: Rational,
    /// base^exponent
    pub(super) plain: Vec<(ExprId, Rational)>,
    /// exp(argument)^exponent
    exponentials: Vec<(ExprId, Rational)>,
    /// (base^exponent)^n with an exponent that is not a number
    powers: Vec<(ExprId, ExprId, Rational)>,
}

impl Pool {
    /// Π
    pub fn product(&mut self, factors: &[ExprId]) -> ExprId {
        let factors: Vec<_> = factors.iter().map(|&e| (e, Rational::ONE)).collect();
        self.monomial(Rational::ONE, &factors)
    }

    /// a b
    pub fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.monomial(Rational::ONE, &[(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// a / b; None if b is the number 0.
    pub fn div(&mut self, a: ExprId, b: ExprId) -> Option<ExprId> {
        if self.is_zero(b) {
            return None;
        }
        Some(self.monomial(
            Rational::ONE,
            &[(a, Rational::ONE), (b, Rational::MINUS_ONE)],
        ))
    }

    /// base^exponent; None for 0 to a negative power.
    pub fn pow(&mut self, base: ExprId, exponent: ExprId) -> Option<ExprId> {
        match self.as_number(exponent) {
            Some(r) if r.is_negative() && self.is_zero(base) => None,
            Some(r) => Some(self.raise(base, r)),
            None => Some(self.power(base, exponent)),
        }
    }

    /// √a = a^(1/2)
    pub fn sqrt(&mut self, a: ExprId) -> ExprId {
        self.raise(a, Rational::HALF)
    }

    /// base^r; 0 to a negative power is kept as such (its value is infinite).
    pub fn raise(&mut self, base: ExprId, r: Rational) -> ExprId {
        self.monomial(Rational::ONE, &[(base, r)])
    }

    /// base^exponent with an exponent that is not a number.
    pub(super) fn power(&mut self, base: ExprId, exponent: ExprId) -> ExprId {
        match self.node(base) {
            Node::Number(n) if n.is_one() => base,
            Node::Call(Function::Exp, arguments) => {
                let argument = arguments[0];
                let argument = self.mul(argument, exponent);
                self.call(Function::Exp, &[argument])
            }
            _ => self.intern(Node::Power(base, exponent)),
        }
    }

    /// coefficient · Π baseᵢ^exponentᵢ of any expressions and rational exponents.
    pub fn monomial(&mut self, coefficient: Rational, factors: &[(ExprId, Rational)]) -> ExprId {
        let (coefficient, core) = self.monomial_parts(coefficient, factors);
        self.scale(core, coefficient)
    }

    /// The same as a number times an expression (1 if the product is just a number).
    pub(super) fn monomial_parts(
        &mut self,
        coefficient: Rational,
        factors: &[(ExprId, Rational)],
    ) -> (Rational, ExprId) {
        let mut all = Factors {
            coefficient,
            plain: Vec::with_capacity(factors.len() + 4),
            exponentials: Vec::new(),
            powers: Vec::new(),
        };
        for &(e, r) in factors {
            self.multiply(&mut all, e, r);
        }
        loop {
            all.plain.sort_by_key(|&(e, _)| e);
            let mut plain = std::mem::take(&mut all.plain);
            self.collect(&mut plain);
            all.plain = plain;
            self.merge_exponentials(&mut all);
            self.merge_powers(&mut all);
            // Collecting can complete a root, √u √u = u, and merging can give new factors.
            if !self.settle(&mut all) {
                break;
            }
        }
        if all.coefficient.is_zero() {
            // 0/0 stays visibly undefined.
            let zero = self.integer(0);
            all.plain.retain(|&(base, _)| base == zero);
            all.coefficient = Rational::integer(i64::from(!all.plain.is_empty()));
        }
        let is_high = |&(_, r): &(ExprId, Rational)| r.floor().unsigned_abs() > MOST_EXPONENT;
        if all.plain.iter().any(is_high) {
            self.note_outgrown(Outgrown::Exponents);
        }
        let core = match all.plain[..] {
            [] => self.integer(1),
            [(base, exponent)] if exponent.is_one() => base,
            _ => self.intern(Node::Product(all.plain)),
        };
        (all.coefficient, core)
    }

    /// Multiplies by e^r.
    fn multiply(&mut self, all: &mut Factors, e: ExprId, r: Rational) {
        if r.is_zero() {
            return;
        }
        match self.node(e) {
            Node::Number(n) => {
                let n = *n;
                self.multiply_number(all, n, r);
            }
            Node::Sum { constant, terms } => {
                if constant.is_zero() && terms.len() == 1 {
                    let (term, c) = terms[0];
                    self.multiply_scaled(all, e, term, c, r);
                    return;
                }
                let (mut content, mut part) = self.primitive_part(e);
                if content.is_negative() && !r.is_integer() {
                    content = self.negative(content);
                    part = self.neg(part);
                }
                if !content.is_one() {
                    self.multiply_number(all, content, r);
                }
                all.plain.push((part, r));
            }
            Node::Product(factors) => {
                if r.is_one() && !self.has_merging(e) {
                    all.plain.extend_from_slice(factors);
                } else {
                    self.multiply_product(all, e, r);
                }
            }
            Node::Call(Function::Exp, arguments) => all.exponentials.push((arguments[0], r)),
            Node::Power(base, exponent) if r.is_integer() => all.powers.push((*base, *exponent, r)),
            _ => all.plain.push((e, r)),
        }
    }

    /// Multiplies by (c·term)^r, e = c·term.
    fn multiply_scaled(
        &mut self,
        all: &mut Factors,
        e: ExprId,
        term: ExprId,
        c: Rational,
        r: Rational,
    ) {
        if r.is_integer() || !c.is_negative() {
            self.multiply_number(all, c, r);
            self.multiply(all, term, r);
        } else if c == Rational::MINUS_ONE {
            all.plain.push((e, r));
        } else {
            let size = self.negative(c);
            self.multiply_number(all, size, r);
            let opposite = self.scale(term, Rational::MINUS_ONE);
            all.plain.push((opposite, r));
        }
    }

    /// Multiplies by (Π bᵢ^aᵢ)^r: factor by factor if r is an integer; else factors that cannot be negative come
    /// out, and what remains is one base.
    fn multiply_product(&mut self, all: &mut Factors, e: ExprId, r: Rational) {
        let Node::Product(factors) = self.node(e) else {
            return;
        };
        let factors = factors.clone();
        let mut rest = Vec::new();
        for &(base, exponent) in &factors {
            let free = r.is_integer() || !exponent.is_integer() || self.is_positive(base);
            if free {
                let exponent = self.times(exponent, r);
                self.multiply(all, base, exponent);
            } else {
                rest.push((base, exponent));
            }
        }
        match rest[..] {
            [] => {}
            [(base, exponent)] if exponent.is_one() => self.multiply(all, base, r),
            _ => {
                let base = if rest.len() == factors.len() {
                    e
                } else {
                    self.intern(Node::Product(rest))
                };
                all.plain.push((base, r));
            }
        }
    }

    /// Whether its form shows that it is positive.
    fn is_positive(&self, e: ExprId) -> bool {
        match self.node(e) {
            Node::Number(n) => !n.is_negative(),
            Node::Pi => true,
            Node::Call(f, _) => matches!(f, Function::Exp | Function::Cosh),
            _ => false,
        }
    }

    /// Whether its form shows that it is never negative, as a distance is.
    pub fn is_never_negative(&self, e: ExprId) -> bool {
        match self.node(e) {
            Node::Sum { constant, terms } => {
                let mut terms = terms.iter();
                !constant.is_negative()
                    && terms.all(|&(term, c)| !c.is_negative() && self.is_never_negative(term))
            }
            Node::Product(factors) => factors.iter().all(|&(base, exponent)| {
                let even = exponent.to_integer().map(|n| n % 2 == 0);
                even.unwrap_or(true) || self.is_never_negative(base)
            }),
            Node::Group(inner) => self.is_never_negative(*inner),
            _ => self.is_positive(e),
        }
    }

    /// exp a · exp b = exp(a + b)
    fn merge_exponentials(&mut self, all: &mut Factors) {
        if all.exponentials.is_empty() {
            return;
        }
        let arguments = std::mem::take(&mut all.exponentials);
        let argument = self.linear(Rational::ZERO, arguments);
        let e = self.call(Function::Exp, &[argument]);
        match self.node(e) {
            Node::Call(Function::Exp, _) => all.plain.push((e, Rational::ONE)),
            _ => self.multiply(all, e, Rational::ONE),
        }
        all.plain.sort_by_key(|&(e, _)| e);
        let mut plain = std::mem::take(&mut all.plain);
        self.collect(&mut plain);
        all.plain = plain;
    }

    /// b^u b^v b^2 = b^(u+v+2)
    fn merge_powers(&mut self, all: &mut Factors) {
        if all.powers.is_empty() {
            return;
        }
        let mut powers = std::mem::take(&mut all.powers);
        powers.sort();
        let mut at = 0;
        while at < powers.len() {
            let base = powers[at].0;
            let mut terms = Vec::new();
            while at < powers.len() && powers[at].0 == base {
                terms.push((powers[at].1, powers[at].2));
                at += 1;
            }
            let mut constant = Rational::ZERO;
            if let Ok(found) = all.plain.binary_search_by_key(&base, |&(e, _)| e) {
                constant = all.plain.remove(found).1;
            }
            let exponent = self.linear(constant, terms);
            match self.as_number(exponent) {
                Some(r) => self.multiply(all, base, r),
                None => {
                    let power = self.power(base, exponent);
                    all.plain.push((power, Rational::ONE));
                }
            }
            all.plain.sort_by_key(|&(e, _)| e);
        }
    }

    /// Takes integer parts out of the exponents of numbers, multiplies out bases that are products or multiples and whose exponent has become
    /// an integer, and divides by no tangent. Whether the factors must be collected again.
    fn settle(&mut self, all: &mut Factors) -> bool {
        let mut again = !all.exponentials.is_empty() || !all.powers.is_empty();
        let mut at = 0;
        while at < all.plain.len() {
            let (base, exponent) = all.plain[at];
            let opened = match self.node(base) {
                Node::Number(n) if !n.is_zero() => {
                    let n = *n;
                    let whole = exponent.floor();
                    if whole != 0 {
                        let power = i64::try_from(whole).ok().and_then(|k| n.pow_int(k));
                        let power = self.checked(power);
                        all.coefficient = self.times(all.coefficient, power);
                        let whole = Rational::new(whole, 1);
                        let whole = self.checked(whole);
                        let rest = self.checked(exponent.checked_sub(whole));
                        if rest.is_zero() {
                            all.plain.remove(at);
                            continue;
                        }
                        all.plain[at].1 = rest;
                    }
                    false
                }
                Node::Product(_) => exponent.is_integer(),
                Node::Sum { constant, terms } => {
                    exponent.is_integer()
                        && ((constant.is_zero() && terms.len() == 1) || terms[0].1.is_negative())
                }
                _ => false,
            };
            if opened {
                all.plain.remove(at);
                self.multiply(all, base, exponent);
                again = true;
            } else if let Some(quotient) = self.inverse_tangent(base, exponent) {
                all.plain.remove(at);
                all.plain.extend(quotient);
                again = true;
            } else {
                at += 1;
            }
        }
        again
    }

    /// 1/tan u = cos u / sin u, which has a value where tan u has none.
    fn inverse_tangent(
        &mut self,
        base: ExprId,
        exponent: Rational,
    ) -> Option<[(ExprId, Rational); 2]> {
        let Node::Call(Function::Tan, arguments) = self.node(base) else {
            return None;
        };
        let argument = [arguments[0]];
        let divides = exponent.is_integer() && exponent.is_negative();
        divides.then(|| {
            let [sine, cosine] = [Function::Sin, Function::Cos].map(|f| self.call(f, &argument));
            [(cosine, self.negative(exponent)), (sine, exponent)]
        })
    }
}
