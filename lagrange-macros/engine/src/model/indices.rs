//! Indices: known at build time, within ranges, free of other meanings; and sums over them.

use super::depth::{Context, Reach};
use super::elaboration::Elaboration;
use super::value::Value;
use crate::ast::{Expr, Index, Name, Range};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::{MOST_OPERANDS, Rational};

/// What a sum, an array or an indexed item may unroll to.
const MOST_ELEMENTS: i64 = 10_000;

/// What all of them may unroll to; sums inside of sums multiply.
const MOST_UNROLLED: i64 = 1_000_000;

impl Elaboration<'_> {
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

    /// The bounds of a range that is not too long.
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
        self.unroll((to - from).max(0), extent)?;
        Some((from, to))
    }

    /// Counts elements that are about to be made.
    pub fn unroll(&mut self, count: i64, at: Extent) -> Option<()> {
        self.unrolled = self.unrolled.saturating_add(count);
        if self.unrolled > MOST_UNROLLED {
            let elements = &[&self.unrolled as &dyn std::fmt::Display, &MOST_UNROLLED];
            self.sink.report(Code::TooMany, at, elements);
            return None;
        }
        Some(())
    }

    /// The list of these elements; what is in them is counted, because lists inside of lists multiply.
    pub(super) fn list(&mut self, elements: Vec<Value>, at: Extent) -> Option<Value> {
        let list = Value::List(elements);
        self.unroll(list.size() as i64, at)?;
        Some(list)
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

    /// `list(i in a..b: body)`: the values of a body for every value of its index, which have one shape.
    pub(super) fn each_of(
        &mut self,
        index: &Index,
        body: &Expr,
        at: Extent,
        context: Context,
    ) -> Option<Vec<Value>> {
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
        Some(values)
    }

    /// `sum(i in a..b: body)`; an empty range gives 0.
    pub(super) fn sum_over(
        &mut self,
        index: &Index,
        body: &Expr,
        at: Extent,
        context: Context,
    ) -> Option<Value> {
        let values = self.each_of(index, body, at, context)?;
        if values.is_empty() {
            return Some(Value::Scalar(self.system.pool.integer(0)));
        }
        self.total(values)
    }
}
