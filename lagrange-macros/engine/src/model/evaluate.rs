//! Expressions as written → values over the pool. `None`: there was a mistake, and it has been reported.

use super::elaborate::Elaboration;
use super::names::{Kind, Meaning};
use super::reach::{Context, Reach};
use super::value::Value;
use crate::ast::{Decimal, Expr, ExprKind, Factor, Index, Name, Range, Reference, Sign};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::{ExprId, MOST_OPERANDS, Rational};

/// What sums and indexed items may unroll to.
const MOST_ELEMENTS: i64 = 10_000;

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
                self.sink
                    .report(Code::ListForScalar, at, &[&elements.len()]);
                None
            }
        }
    }

    /// A value of any shape.
    pub fn value(&mut self, expr: &Expr, context: Context) -> Option<Value> {
        let value = self.form(expr, context);
        if self.system.pool.overflowed() && !self.overflowed {
            self.overflowed = true;
            self.sink.report(Code::Overflow, expr.extent, &[]);
        }
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
                let (b, e) = (b?, e?);
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
            ExprKind::List(elements) => {
                let elements: Vec<Option<Value>> =
                    elements.iter().map(|e| self.value(e, context)).collect();
                elements
                    .into_iter()
                    .collect::<Option<Vec<Value>>>()
                    .map(Value::List)
            }
            ExprKind::Element(base, index) => self.element(base, index, context),
            ExprKind::Member(base, name) => self.member(base, name, context),
        }
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
        let Some(power) = pool.as_number(exponent) else {
            return Some(());
        };
        let zero = pool.is_zero(base) && power.is_zero();
        let negative = pool.as_number(base).is_some_and(Rational::is_negative);
        if zero || negative && !power.is_integer() {
            self.sink.report(Code::NoValue, expr.extent, &[expr]);
            return None;
        }
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
    fn total(&mut self, values: Vec<Value>) -> Option<Value> {
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
    fn fits(&mut self, first: &Value, term: &Value, at: Extent) -> Option<()> {
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
                self.sink
                    .report(Code::ListForScalar, at, &[&elements.len()]);
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
                    let Some(inverse) = self.system.pool.div(one, e) else {
                        self.sink.report(Code::DivisionByZero, factor.extent, &[]);
                        return None;
                    };
                    scalars.push(inverse);
                }
                (Factor::Times, value) if list.is_none() => list = Some(value),
                (Factor::Times, _) => {
                    self.sink
                        .report(Code::ListProduct, factor.extent, &[&"the product"]);
                    return None;
                }
                (Factor::Over, _) => {
                    self.sink
                        .report(Code::ListProduct, factor.extent, &[&"the quotient"]);
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

    /// `pi`, `t`, an index, `energy`, or a name of the namespace.
    fn named(&mut self, name: &Name, context: Context) -> Option<Value> {
        let text = name.text.as_str();
        match text {
            "pi" => return Some(Value::Scalar(self.system.pool.pi())),
            "t" => {
                let time = self.system.time;
                return Some(Value::Scalar(self.system.pool.leaf(time)));
            }
            "energy" => return self.energy(name, context).map(Value::Scalar),
            _ => {}
        }
        if let Some(&(_, index)) = self.indices.iter().rev().find(|(known, _)| known == text) {
            return Some(Value::Scalar(self.system.pool.integer(index)));
        }
        if super::names::is_reserved(text) {
            let hint = format!("write `{text}(…)`");
            self.sink.report(
                Code::WrongKind,
                name,
                &[&text, &"function", &"value", &hint],
            );
            return None;
        }
        self.meaning(name, context).map(|(value, _)| value)
    }

    /// The value of a name of the namespace, and where its indices begin.
    fn meaning(&mut self, name: &Name, context: Context) -> Option<(Value, i64)> {
        let Some(entry) = self.names.get(&name.text) else {
            self.unknown(name);
            return None;
        };
        let kind = entry.kind;
        match entry.meaning.clone() {
            Meaning::Poisoned => None,
            Meaning::Pending(definition) => {
                self.define(definition);
                self.meaning(name, context)
            }
            Meaning::Busy => {
                let hint = "its value is needed to find its value";
                self.sink.report(Code::Circular, name, &[&name.text, &hint]);
                None
            }
            Meaning::Value { .. } if kind == Kind::Output && context.reach != Reach::Outputs => {
                self.sink.report(Code::OutputOnly, name, &[&name.text]);
                None
            }
            Meaning::Value {
                value,
                lower,
                depth,
            } => {
                self.admit(depth, context, &name.text, name.into())?;
                Some((value, lower))
            }
            Meaning::Item { elements, lower } => {
                self.admit_item(name, kind, context)?;
                let mut values: Vec<Value> = elements
                    .into_iter()
                    .map(|element| self.force_of(kind, element))
                    .collect();
                match lower {
                    Some(lower) => Some((Value::List(values), lower)),
                    None => values.pop().map(|only| (only, 0)),
                }
            }
        }
    }

    /// `base[index]`
    fn element(&mut self, base: &Expr, index: &Expr, context: Context) -> Option<Value> {
        let is_name = |name: &Name| self.names.contains_key(&name.text);
        let (value, lower) = match &base.kind {
            ExprKind::Name(name) if is_name(name) => self.meaning(name, context)?,
            _ => (self.value(base, context)?, 0),
        };
        let Value::List(mut elements) = value else {
            let hint = format!("`{base}` is one number, take the index away");
            self.sink.report(Code::ScalarForList, base.extent, &[&hint]);
            return None;
        };
        let at = self.position(index, lower, elements.len())?;
        Some(elements.swap_remove(at))
    }

    /// The position of an index in a list of `length` elements whose first index is `lower`.
    pub fn position(&mut self, index: &Expr, lower: i64, length: usize) -> Option<usize> {
        let value = self.integer(index)?;
        let position = value
            .checked_sub(lower)
            .and_then(|k| usize::try_from(k).ok());
        let position = position.filter(|&k| k < length);
        if position.is_none() {
            let upper = lower + length as i64;
            self.sink
                .report(Code::IndexRange, index.extent, &[&value, &lower, &upper]);
        }
        position
    }

    /// An integer known at build time.
    pub fn integer(&mut self, expr: &Expr) -> Option<i64> {
        let value = self.scalar(expr, Context::new(Reach::Definition, "an index"))?;
        let integer = self
            .system
            .pool
            .as_number(value)
            .and_then(Rational::to_integer);
        if integer.is_none() {
            self.sink.report(Code::NotAnInteger, expr.extent, &[]);
        }
        integer
    }

    /// The bounds of a range that is not empty and not too long.
    pub fn bounds(&mut self, range: &Range) -> Option<(i64, i64)> {
        let (from, to) = (self.integer(&range.from), self.integer(&range.to));
        let (from, to) = (from?, to?);
        let extent = Extent::new(range.from.extent, range.to.extent);
        if to
            .checked_sub(from)
            .is_none_or(|count| count > MOST_ELEMENTS)
        {
            let count = i128::from(to) - i128::from(from);
            self.sink
                .report(Code::TooMany, extent, &[&count, &MOST_ELEMENTS]);
            return None;
        }
        Some((from, to))
    }

    /// Enters an index for as long as `body` runs.
    pub fn with_index<R>(
        &mut self,
        name: &Name,
        index: i64,
        body: impl FnOnce(&mut Self) -> R,
    ) -> R {
        self.indices.push((name.text.clone(), index));
        let result = body(self);
        self.indices.pop();
        result
    }

    /// Whether a name is free to be an index.
    pub fn free_index(&mut self, name: &Name) -> Option<()> {
        let text = name.text.as_str();
        if super::names::is_reserved(text) {
            self.sink.report(Code::ReservedName, name, &[&text]);
            return None;
        }
        let hidden = match self.names.get(text) {
            Some(entry) => entry.kind.text(),
            None if self.indices.iter().any(|(known, _)| known == text) => "index",
            None => return Some(()),
        };
        self.sink
            .report(Code::IndexShadows, name, &[&text, &hidden]);
        None
    }

    /// `sum(i in a..b: body)`; an empty range gives 0.
    fn sum_over(
        &mut self,
        index: &Index,
        body: &Expr,
        at: Extent,
        context: Context,
    ) -> Option<Value> {
        self.free_index(&index.name)?;
        let (from, to) = self.bounds(&index.range)?;
        let mut values = Vec::new();
        for k in from..to {
            if self.system.pool.is_full() {
                let (name, most) = (self.system.name.clone(), MOST_OPERANDS);
                self.sink.report(Code::TooLarge, at, &[&name, &most]);
                return None;
            }
            let value = self.with_index(&index.name, k, |this| this.value(body, context))?;
            if let Some(first) = values.first() {
                self.fits(first, &value, at)?;
            }
            values.push(value);
        }
        if values.is_empty() {
            return Some(Value::Scalar(self.system.pool.integer(0)));
        }
        self.total(values)
    }

    /// An item's name as the target of a call: `gap(c)`, `momentum(x[2])`.
    pub fn reference(&mut self, expr: &Expr) -> Option<Reference> {
        let found = match &expr.kind {
            ExprKind::Name(name) => Some((name, None)),
            ExprKind::Element(base, index) => match &base.kind {
                ExprKind::Name(name) => Some((name, Some((**index).clone()))),
                _ => None,
            },
            _ => None,
        };
        let Some((name, element)) = found else {
            self.sink.report(
                Code::Expected,
                expr.extent,
                &[&"the name of an item", &format!("`{expr}`")],
            );
            return None;
        };
        Some(Reference {
            name: name.clone(),
            element,
        })
    }
}
