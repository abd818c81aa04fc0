//! Expressions as written → values over the pool. `None`: there was a mistake, and it has been reported.

use super::depth::Context;
use super::elaboration::Elaboration;
use super::value::Value;
use crate::ast::{Decimal, Expr, ExprKind, Factor, Sign};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::{ExprId, Node, Rational};

/// Numerators and denominators of exponents are at most this.
const HIGHEST_POWER: i64 = 1_000;

impl Elaboration<'_> {
    /// A single value.
    pub fn scalar(&mut self, expr: &Expr, context: Context) -> Option<ExprId> {
        let value = self.value(expr, context)?;
        self.single(value, expr.extent)
    }

    pub fn single(&mut self, value: Value, at: Extent) -> Option<ExprId> {
        match value {
            Value::Scalar(e) => Some(e),
            Value::List(elements) => {
                let hint = "take one element `e[i]`, or `dot`, `norm`, `sum`";
                self.sink
                    .report(Code::ListForScalar, at, &[&elements.len(), &hint]);
                None
            }
        }
    }

    /// A value of any shape.
    pub fn value(&mut self, expr: &Expr, context: Context) -> Option<Value> {
        let value = self.form(expr, context);
        self.check_overflow(expr.extent, &format_args!("`{expr}`"));
        value
    }

    fn form(&mut self, expr: &Expr, context: Context) -> Option<Value> {
        match &expr.kind {
            ExprKind::Number(decimal) => {
                let number = self.exact(*decimal, expr.extent)?;
                Some(Value::Scalar(self.system.pool.number(number)))
            }
            ExprKind::Name(name) => self.named(name, context),
            ExprKind::Sum(terms) => self.terms(terms, context),
            ExprKind::Product(factors) => self.factors(factors, context),
            ExprKind::Negative(inner) => {
                let value = self.value(inner, context)?;
                Some(value.map(&mut |e| self.system.pool.neg(e)))
            }
            ExprKind::Power(base, exponent) => {
                let (b, e) = (self.scalar(base, context), self.scalar(exponent, context));
                let (b, e) = (self.zero_or_not(b?), e?);
                self.power_exists(expr, exponent.extent, b, e)?;
                let power = self.system.pool.pow(b, e);
                if power.is_none() {
                    self.sink.report(Code::DivisionByZero, expr.extent, &[]);
                }
                power.map(Value::Scalar)
            }
            ExprKind::Call(name, arguments) => self.call(expr, name, arguments, context),
            ExprKind::If(condition, then, otherwise) => {
                self.conditional(expr, condition, then, otherwise, context)
            }
            ExprKind::SumOver(index, body) => self.sum_over(index, body, expr.extent, context),
            ExprKind::ListOver(index, body) => {
                let elements = self.each_of(index, body, expr.extent, context)?;
                self.list(elements, expr.extent)
            }
            ExprKind::List(elements) => {
                let elements: Vec<Option<Value>> =
                    elements.iter().map(|e| self.value(e, context)).collect();
                let elements = elements.into_iter().collect::<Option<Vec<Value>>>()?;
                self.list(elements, expr.extent)
            }
            ExprKind::Element(base, index) => self.element(base, index, context),
            ExprKind::Member(base, name) => self.member(base, name, context),
        }
    }

    /// The number 0 for what is zero in a form that does not show it, `(a + b)^2 - a^2 - 2*a*b - b^2`: what divides by it, or
    /// takes its root, must know.
    pub(super) fn zero_or_not(&mut self, e: ExprId) -> ExprId {
        let pool = &mut self.system.pool;
        let is_plain = matches!(pool.node(e), Node::Number(_) | Node::Symbol(_));
        if !is_plain && pool.vanishes(e) {
            return pool.integer(0);
        }
        e
    }

    /// Whether numbers have this power, and it is not absurdly high.
    fn power_exists(
        &mut self,
        expr: &Expr,
        at: Extent,
        base: ExprId,
        exponent: ExprId,
    ) -> Option<()> {
        let pool = &self.system.pool;
        let power = pool.as_number(exponent);
        let zero = pool.is_zero(base) && power.is_some_and(Rational::is_zero);
        let negative = pool.as_number(base).is_some_and(Rational::is_negative);
        // An exponent that is not known is not a whole number at all times.
        let whole = power.is_some_and(Rational::is_integer);
        if zero || negative && !whole {
            self.sink.report(Code::NoValue, expr.extent, &[expr]);
            return None;
        }
        let Some(power) = power else {
            return Some(());
        };
        let most = i128::from(HIGHEST_POWER);
        if power.numerator().unsigned_abs() > most.unsigned_abs() || power.denominator() > most {
            self.sink.report(Code::HighPower, at, &[&HIGHEST_POWER]);
            return None;
        }
        Some(())
    }

    fn exact(&mut self, decimal: Decimal, at: Extent) -> Option<Rational> {
        let scale = 10i128.checked_pow(decimal.exponent.unsigned_abs());
        let number = scale.and_then(|scale| match decimal.exponent >= 0 {
            true => Rational::new(decimal.digits.checked_mul(scale)?, 1),
            false => Rational::new(decimal.digits, scale),
        });
        if number.is_none() {
            self.sink.report(Code::NumberSize, at, &[&decimal]);
        }
        number
    }

    fn terms(&mut self, terms: &[(Sign, Expr)], context: Context) -> Option<Value> {
        let values: Vec<Option<Value>> = terms
            .iter()
            .map(|(_, term)| self.value(term, context))
            .collect();
        let values: Vec<Value> = values.into_iter().collect::<Option<_>>()?;
        for ((_, term), value) in terms.iter().zip(&values).skip(1) {
            self.fits(&values[0], value, term.extent)?;
        }
        let signed: Vec<Value> = terms
            .iter()
            .zip(&values)
            .map(|((sign, _), value)| match sign {
                Sign::Plus => value.clone(),
                Sign::Minus => value.map(&mut |e| self.system.pool.neg(e)),
            })
            .collect();
        self.total(signed)
    }

    /// Σ of values of one shape.
    pub(super) fn total(&mut self, values: Vec<Value>) -> Option<Value> {
        let first = values.first()?.clone();
        if let Value::Scalar(_) = first {
            let scalars: Vec<ExprId> = values.iter().flat_map(Value::scalars).collect();
            return Some(Value::Scalar(self.system.pool.sum(&scalars)));
        }
        values[1..].iter().try_fold(first, |sum, value| {
            sum.zip(value, &mut |a, b| self.system.pool.add(a, b))
        })
    }

    /// Whether a term has the shape of the first.
    pub(super) fn fits(&mut self, first: &Value, term: &Value, at: Extent) -> Option<()> {
        match (first, term) {
            (Value::Scalar(_), Value::Scalar(_)) => Some(()),
            (Value::List(a), Value::List(b)) if a.len() == b.len() => {
                a.iter().zip(b).try_for_each(|(a, b)| self.fits(a, b, at))
            }
            (Value::List(a), Value::List(b)) => {
                self.sink.report(Code::Lengths, at, &[&a.len(), &b.len()]);
                None
            }
            (Value::List(_), Value::Scalar(_)) => {
                let hint = "a list and a single value do not add; write the list out, `[a, a]`";
                self.sink.report(Code::ScalarForList, at, &[&hint]);
                None
            }
            (Value::Scalar(_), Value::List(elements)) => {
                let hint = "a single value and a list do not add; write the single value as a list, `[a, a]`";
                self.sink
                    .report(Code::ListForScalar, at, &[&elements.len(), &hint]);
                None
            }
        }
    }

    fn factors(&mut self, factors: &[(Factor, Expr)], context: Context) -> Option<Value> {
        let values: Vec<Option<Value>> = factors
            .iter()
            .map(|(_, factor)| self.value(factor, context))
            .collect();
        let values: Vec<Value> = values.into_iter().collect::<Option<_>>()?;
        let mut scalars = Vec::new();
        let mut list = None;
        for ((side, factor), value) in factors.iter().zip(values) {
            match (side, value) {
                (Factor::Times, Value::Scalar(e)) => scalars.push(e),
                (Factor::Over, Value::Scalar(e)) => {
                    let one = self.system.pool.integer(1);
                    let divisor = self.zero_or_not(e);
                    let Some(inverse) = self.system.pool.div(one, divisor) else {
                        self.sink.report(Code::DivisionByZero, factor.extent, &[]);
                        return None;
                    };
                    scalars.push(inverse);
                }
                (Factor::Times, value) if list.is_none() => list = Some(value),
                (Factor::Times, _) => {
                    self.sink.report(Code::ListProduct, factor.extent, &[]);
                    return None;
                }
                (Factor::Over, _) => {
                    self.sink.report(Code::ListDivisor, factor.extent, &[]);
                    return None;
                }
            }
        }
        let product = self.system.pool.product(&scalars);
        Some(match list {
            None => Value::Scalar(product),
            Some(list) => list.map(&mut |e| self.system.pool.mul(product, e)),
        })
    }
}
