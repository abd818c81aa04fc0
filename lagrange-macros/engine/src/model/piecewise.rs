//! `abs sign min max if` → selections on numbered branches; a guard ≥ 0 selects the first side.

use super::Branch;
use super::depth::Context;
use super::elaboration::Elaboration;
use super::value::Value;
use crate::ast::{Comparison, Expr, Relation};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::ExprId;
use core::fmt::Display;

/// What holds on the `then` side and on the other one, `x >= 0` and `x < 0`.
pub(super) struct Sides([String; 2]);

impl Sides {
    /// `left >= right` or `left <= right` holds on the `then` side.
    pub fn of(left: &dyn Display, relation: Relation, right: &dyn Display) -> Self {
        Self(match relation {
            Relation::AtLeast => [format!("{left} >= {right}"), format!("{left} < {right}")],
            Relation::AtMost => [format!("{left} <= {right}"), format!("{left} > {right}")],
        })
    }
}

impl Elaboration<'_> {
    /// `then` while guard ≥ 0; equal guards share a branch, and a guard that is a number decides at once.
    fn select(
        &mut self,
        declared: ExprId,
        then: ExprId,
        otherwise: ExprId,
        Sides([holds, fails]): Sides,
        at: Extent,
    ) -> ExprId {
        let guard = self.on_argument(declared);
        if let Some(number) = self.system.pool.as_number(guard) {
            return if number.is_negative() {
                otherwise
            } else {
                then
            };
        }
        let branches = &mut self.system.branches;
        let next = branches.len();
        let branch = *self.branches.get_or_insert(guard, next);
        if branch == next {
            branches.push(Branch {
                guard,
                declared,
                then: holds,
                otherwise: fails,
                span: at.start,
            });
        }
        self.system.pool.select(branch, then, otherwise)
    }

    /// An expression in the words of the user, with numbers for indices: `w[0]` and `w[1]` are told apart.
    fn words(&self, declared: &Expr) -> String {
        let index = |name: &str| {
            let mut entered = self.indices.iter();
            entered.find(|(known, _)| known == name).map(|&(_, k)| k)
        };
        declared.at(&index).to_string()
    }

    /// abs(u): u, −u by u.
    pub fn absolute(&mut self, u: ExprId, declared: &Expr) -> ExprId {
        let minus = self.system.pool.neg(u);
        let sides = Sides::of(&self.words(declared), Relation::AtLeast, &0);
        self.select(u, u, minus, sides, declared.extent)
    }

    /// sign(u): 1, −1 by u.
    pub fn sign(&mut self, u: ExprId, declared: &Expr) -> ExprId {
        let (plus, minus) = (self.system.pool.integer(1), self.system.pool.integer(-1));
        let sides = Sides::of(&self.words(declared), Relation::AtLeast, &0);
        self.select(u, plus, minus, sides, declared.extent)
    }

    /// max(a, b, …): a, b by a − b; min(a, b, …): a, b by b − a.
    pub fn extreme(
        &mut self,
        name: &str,
        declared: &[Expr],
        values: &[ExprId],
        at: Extent,
    ) -> ExprId {
        let mut extreme = values[0];
        for (k, &value) in values.iter().enumerate().skip(1) {
            let (guard, relation) = match name {
                "min" => (self.system.pool.sub(value, extreme), Relation::AtMost),
                _ => (self.system.pool.sub(extreme, value), Relation::AtLeast),
            };
            let before: Vec<String> = declared[..k].iter().map(|e| self.words(e)).collect();
            let before = match before.as_slice() {
                [only] => only.clone(),
                several => format!("{name}({})", several.join(", ")),
            };
            let sides = Sides::of(&before, relation, &self.words(&declared[k]));
            extreme = self.select(guard, extreme, value, sides, at);
        }
        extreme
    }

    /// if(a >= b, then, otherwise); where the condition is known, the other side is not looked at.
    pub fn conditional(
        &mut self,
        expr: &Expr,
        condition: &Comparison,
        then: &Expr,
        otherwise: &Expr,
        context: Context,
    ) -> Option<Value> {
        let guard = self.difference(condition, context)?;
        if let Some(number) = self.system.pool.as_number(guard) {
            return self.value(
                if number.is_negative() {
                    otherwise
                } else {
                    then
                },
                context,
            );
        }
        let (first, second) = (self.value(then, context), self.value(otherwise, context));
        let (first, second) = (first?, second?);
        let Comparison {
            left,
            relation,
            right,
        } = condition;
        let (left, right) = (self.words(left), self.words(right));
        let selected = first.zip(&second, &mut |a, b| {
            let sides = Sides::of(&left, *relation, &right);
            self.select(guard, a, b, sides, expr.extent)
        });
        if selected.is_none() {
            let count = |value: &Value| value.length().unwrap_or(1);
            self.sink.report(
                Code::Lengths,
                expr.extent,
                &[&count(&first), &count(&second)],
            );
        }
        selected
    }

    /// larger − smaller side of a comparison.
    pub fn difference(&mut self, comparison: &Comparison, context: Context) -> Option<ExprId> {
        let (larger, smaller) = comparison.sides();
        let (larger, smaller) = (self.scalar(larger, context), self.scalar(smaller, context));
        Some(self.system.pool.sub(larger?, smaller?))
    }
}
