//! `abs sign min max if` → selections on numbered branches; a guard ≥ 0 selects the first side.

use super::Branch;
use super::elaborate::Elaboration;
use super::reach::Context;
use super::value::Value;
use crate::ast::{Comparison, Expr};
use crate::diagnostics::{Code, Extent};
use crate::symbolic::ExprId;

impl Elaboration<'_> {
    /// `then` while guard ≥ 0; equal guards share a branch, and a guard that is a number decides at once.
    fn select(
        &mut self,
        guard: ExprId,
        then: ExprId,
        otherwise: ExprId,
        text: &str,
        at: Extent,
    ) -> ExprId {
        match self.system.pool.as_number(guard) {
            Some(number) if number.is_negative() => otherwise,
            Some(_) => then,
            None => {
                let branch = self.branch(guard, text, at);
                self.system.pool.select(branch, then, otherwise)
            }
        }
    }

    fn branch(&mut self, guard: ExprId, text: &str, at: Extent) -> usize {
        let branches = &mut self.system.branches;
        if let Some(same) = branches.iter().position(|branch| branch.guard == guard) {
            return same;
        }
        branches.push(Branch {
            guard,
            text: text.to_string(),
            span: at.start,
        });
        branches.len() - 1
    }

    /// abs(u): u, −u by u.
    pub fn absolute(&mut self, u: ExprId, text: &str, at: Extent) -> ExprId {
        let minus = self.system.pool.neg(u);
        self.select(u, u, minus, text, at)
    }

    /// sign(u): 1, −1 by u.
    pub fn sign(&mut self, u: ExprId, text: &str, at: Extent) -> ExprId {
        let (plus, minus) = (self.system.pool.integer(1), self.system.pool.integer(-1));
        self.select(u, plus, minus, text, at)
    }

    /// max(a, b): a, b by a − b.
    pub fn maximum(&mut self, a: ExprId, b: ExprId, text: &str, at: Extent) -> ExprId {
        let guard = self.system.pool.sub(a, b);
        self.select(guard, a, b, text, at)
    }

    /// min(a, b): a, b by b − a.
    pub fn minimum(&mut self, a: ExprId, b: ExprId, text: &str, at: Extent) -> ExprId {
        let guard = self.system.pool.sub(b, a);
        self.select(guard, a, b, text, at)
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
        let text = expr.to_string();
        let selected = first.zip(&second, &mut |a, b| {
            self.select(guard, a, b, &text, expr.extent)
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
