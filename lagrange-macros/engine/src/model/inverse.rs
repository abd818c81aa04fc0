//! Conditions on inverse functions, as conditions on their arguments.
//!
//! acos(u) ≥ b says what u ≤ cos b does. The first has no Taylor series where u = ±1, and no value where rounding has taken u beyond: the angle of a
//! pendulum comes there whenever it hangs. Likewise √u ≥ b is u ≥ b².

use super::depth::{Context, Depth};
use super::elaboration::Elaboration;
use crate::ast::Comparison;
use crate::symbolic::{ExprId, Function, Node, Rational};

/// What can be undone: it grows with its argument, or falls.
#[derive(Clone, Copy, PartialEq)]
enum Inverse {
    Asin,
    Acos,
    /// The power with this exponent, which is positive and no whole number.
    Root(Rational),
}

/// An inverse function of an argument, times a factor that does not move.
#[derive(Clone, Copy)]
struct Term {
    inverse: Inverse,
    argument: ExprId,
    factor: ExprId,
    /// Whether the form of the factor shows that it is positive.
    positive: bool,
}

impl Elaboration<'_> {
    /// An expression that is not negative where a comparison holds.
    pub fn condition(&mut self, comparison: &Comparison, context: Context) -> Option<ExprId> {
        let difference = self.difference(comparison, context)?;
        Some(self.on_argument(difference))
    }

    /// An expression that is not negative where this one is not.
    pub fn on_argument(&mut self, difference: ExprId) -> ExprId {
        match self.undone(difference) {
            Some(undone) => self.on_argument(undone),
            None => difference,
        }
    }

    /// The same without its outermost inverse function, if it has one that decides.
    fn undone(&mut self, difference: ExprId) -> Option<ExprId> {
        let (term, scale, rest) = self.isolate(difference)?;
        let pool = &mut self.system.pool;
        let bound = pool.scale(rest, Rational::MINUS_ONE.checked_div(scale)?);
        let bound = pool.div(bound, term.factor)?;
        let at_least = !scale.is_negative();
        let value = match term.inverse {
            Inverse::Asin => self.at_angle(Function::Sin, bound, [-1, 1])?,
            Inverse::Acos => self.at_angle(Function::Cos, bound, [0, 2])?,
            Inverse::Root(_) if at_least && term.positive && self.system.pool.is_zero(bound) => {
                return Some(self.system.pool.integer(1));
            }
            Inverse::Root(exponent) => self.power_of_root(bound, exponent, term.argument)?,
        };
        let falls = term.inverse == Inverse::Acos;
        let pool = &mut self.system.pool;
        let undone = match at_least != falls {
            true => pool.sub(term.argument, value),
            false => pool.sub(value, term.argument),
        };
        Some(match term.positive {
            true => undone,
            false => pool.mul(undone, term.factor),
        })
    }

    /// (e, c, rest) of a difference c e + rest, where e is the only arc in it that moves, or a root and all that moves.
    fn isolate(&mut self, difference: ExprId) -> Option<(Term, Rational, ExprId)> {
        let (constant, terms) = match self.system.pool.node(difference).clone() {
            Node::Sum { constant, terms } => (constant, terms),
            _ => (Rational::ZERO, vec![(difference, Rational::ONE)]),
        };
        let moving = terms.iter().filter(|&&(term, _)| self.moves(term)).count();
        let mut found = Vec::new();
        for (place, &(e, scale)) in terms.iter().enumerate() {
            let undone = self.inverse(e);
            let alone = |term: &Term| moving == 1 || !matches!(term.inverse, Inverse::Root(_));
            found.extend(undone.filter(alone).map(|term| (place, term, scale)));
        }
        let [(place, term, scale)] = found[..] else {
            return None;
        };
        let mut rest = terms;
        rest.remove(place);
        Some((term, scale, self.system.pool.linear(constant, rest)))
    }

    /// The inverse function that an expression is but for a factor, if its argument moves.
    fn inverse(&mut self, e: ExprId) -> Option<Term> {
        let factors = match self.system.pool.node(e).clone() {
            Node::Product(factors) => factors,
            _ => vec![(e, Rational::ONE)],
        };
        let (moving, fixed): (Vec<_>, Vec<_>) =
            factors.into_iter().partition(|&(base, _)| self.moves(base));
        let [(base, exponent)] = moving[..] else {
            return None;
        };
        let positive = |&(base, exponent): &(ExprId, Rational)| {
            let is_root = exponent.denominator() % 2 == 0;
            is_root || matches!(self.system.pool.node(base), Node::Number(_) | Node::Pi)
        };
        let positive = fixed.iter().all(positive);
        let pool = &mut self.system.pool;
        let (inverse, argument) = match pool.node(base) {
            Node::Call(Function::Asin, of) if exponent.is_one() => (Inverse::Asin, of[0]),
            Node::Call(Function::Acos, of) if exponent.is_one() => (Inverse::Acos, of[0]),
            _ if exponent.is_negative() || exponent.is_integer() => return None,
            _ => (Inverse::Root(exponent), base),
        };
        Some(Term {
            inverse,
            argument,
            factor: pool.monomial(Rational::ONE, &fixed),
            positive,
        })
    }

    /// Whether an expression changes during a run. What is 1 or −1 does with the condition that decides on it.
    pub fn moves(&self, e: ExprId) -> bool {
        let pool = &self.system.pool;
        let by_itself =
            |e: ExprId| self.depth(&[e]) > Depth::Parameter || pool.depends_on(e, self.system.time);
        let mut branches = pool.branches(e).into_iter();
        by_itself(e) || branches.any(|b| by_itself(self.system.branches[b].guard))
    }

    /// The value of an expression of numbers alone.
    fn value_without_symbols(&self, e: ExprId) -> Option<f64> {
        let pool = &self.system.pool;
        let is_number = pool.symbols(e).is_empty() && pool.branches(e).is_empty();
        is_number.then(|| pool.evaluate(&[e], &|_| f64::NAN, &|_| true)[0])
    }

    /// sin or cos of the bound of an angle that is between these multiples of π/2. A bound beyond them, which the angle never reaches, becomes a number that its
    /// sine or cosine never does.
    fn at_angle(&mut self, f: Function, bound: ExprId, limits: [i128; 2]) -> Option<ExprId> {
        let half_pi = core::f64::consts::FRAC_PI_2;
        let pi = self.system.pool.pi();
        let mut limit = |multiple| Some(self.system.pool.scale(pi, Rational::new(multiple, 2)?));
        let [least, most] = [limit(limits[0])?, limit(limits[1])?];
        let nearest = match self.value_without_symbols(bound) {
            Some(number) if number < limits[0] as f64 * half_pi => least,
            Some(number) if number > limits[1] as f64 * half_pi => most,
            Some(_) => bound,
            None => {
                let nearest = self.larger(bound, least);
                self.smaller(nearest, most)
            }
        };
        let pool = &mut self.system.pool;
        let beyond = pool.sub(bound, nearest);
        let (at, past) = (
            pool.call(f, &[nearest]),
            pool.call(Function::Tanh, &[beyond]),
        );
        // A sine grows with the angle, a cosine falls.
        Some(match f {
            Function::Sin => pool.add(at, past),
            _ => pool.sub(at, past),
        })
    }

    /// max(a, b) without a branch.
    fn larger(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let pool = &mut self.system.pool;
        let (sum, difference) = (pool.add(a, b), pool.sub(a, b));
        let square = pool.raise(difference, Rational::integer(2));
        let distance = pool.sqrt(square);
        let twice = pool.add(sum, distance);
        pool.scale(twice, Rational::HALF)
    }

    /// min(a, b) without a branch.
    fn smaller(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let pool = &mut self.system.pool;
        let [a, b] = [a, b].map(|e| pool.neg(e));
        let larger = self.larger(a, b);
        self.system.pool.neg(larger)
    }

    /// What u is compared with where u^r is with the bound: b^(1/r), or b itself where that is negative. The root of squares that may be compared with zero stays:
    /// u would only touch that.
    fn power_of_root(
        &mut self,
        bound: ExprId,
        exponent: Rational,
        argument: ExprId,
    ) -> Option<ExprId> {
        let inverse = Rational::ONE.checked_div(exponent)?;
        let number = self.value_without_symbols(bound);
        let is_square = self.is_square(argument);
        if is_square && !number.is_some_and(|number| number > 0.0) {
            return None;
        }
        Some(match number {
            Some(number) if number < 0.0 => bound,
            Some(_) => self.system.pool.raise(bound, inverse),
            None => {
                let zero = self.system.pool.integer(0);
                let (positive, negative) = (self.larger(bound, zero), self.smaller(bound, zero));
                let pool = &mut self.system.pool;
                let power = pool.raise(positive, inverse);
                pool.add(power, negative)
            }
        })
    }

    /// Whether an expression is a sum of squares by its form.
    fn is_square(&self, e: ExprId) -> bool {
        match self.system.pool.node(e) {
            Node::Product(factors) => factors.iter().all(|(_, r)| r.numerator() % 2 == 0),
            Node::Sum { constant, terms } => {
                let square = |&(term, scale): &(ExprId, Rational)| {
                    !scale.is_negative() && self.is_square(term)
                };
                constant.is_zero() && terms.iter().all(square)
            }
            _ => false,
        }
    }
}
