//! Values of the parameters that a file declares: numbers, written as expressions.

use super::System;
use super::depth::{Context, Reach};
use super::elaboration::Elaboration;
use super::value::Value;
use crate::ast::{Declaration, Expr, ExprKind};
use crate::diagnostics::{Code, Diagnostics};
use crate::symbolic::ExprId;

const DEFAULT: Context = Context::new(Reach::Parameters, "the value of a parameter");

/// The values of all parameters, arrays flattened, from an expression for each field of a declaration without mistakes. A single value
/// of an array is that of each element.
pub fn defaults(
    declaration: &Declaration,
    values: &[Expr],
    sink: &mut Diagnostics,
) -> Option<Vec<f64>> {
    let before = sink.count();
    let mut elaboration = fields_only(declaration, sink);
    let mut defaults = Vec::new();
    for (field, expr) in declaration.fields.iter().zip(values) {
        if let Some(numbers) = literals(expr, field.length) {
            defaults.extend(numbers);
            continue;
        }
        let Some(value) = elaboration.value(expr, DEFAULT) else {
            continue;
        };
        let elements = match (field.length, value) {
            (Some(length), Value::List(elements)) if elements.len() == length => elements,
            (Some(length), Value::List(elements)) => {
                let (sink, found) = (&mut elaboration.sink, elements.len());
                sink.report(Code::Lengths, expr.extent, &[&length, &found]);
                continue;
            }
            (length, value) => vec![value; length.unwrap_or(1)],
        };
        for element in elements {
            let e = elaboration.single(element, expr.extent)?;
            defaults.push(elaboration.number(e, expr)?);
        }
    }
    (sink.count() == before).then_some(defaults)
}

/// Numbers written as such: a list of so many, or one for all.
fn literals(expr: &Expr, length: Option<usize>) -> Option<Vec<f64>> {
    match &expr.kind {
        ExprKind::List(elements) if length == Some(elements.len()) => {
            elements.iter().map(literal).collect()
        }
        _ => Some(vec![literal(expr)?; length.unwrap_or(1)]),
    }
}

/// A number written as such. It need not be exact, so that it may be smaller or larger than those in expressions: Planck's constant has
/// 42 digits.
fn literal(expr: &Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Number(number) => Some(number.nearest()),
        ExprKind::Negative(inner) => literal(inner).map(|number| 0.0 - number),
        _ => None,
    }
}

/// The value of a single number.
pub fn number(declaration: &Declaration, value: &Expr, sink: &mut Diagnostics) -> Option<f64> {
    let mut elaboration = fields_only(declaration, sink);
    let e = elaboration.scalar(value, DEFAULT)?;
    elaboration.number(e, value)
}

/// The names of the fields alone, so that a message can say that they have no place in a number.
fn fields_only<'a>(declaration: &Declaration, sink: &'a mut Diagnostics) -> Elaboration<'a> {
    let mut elaboration = Elaboration::new(declaration, sink);
    for field in &declaration.fields {
        elaboration.field(field);
    }
    elaboration
}

impl Elaboration<'_> {
    /// The number that an expression is; reported if it is none.
    fn number(&mut self, e: ExprId, at: &Expr) -> Option<f64> {
        if !self.system.pool.symbols(e).is_empty() {
            let example = "a number, as `3`, `-1/2` or `2*pi` (what follows from other parameters is a `define`)";
            let found = format!("`{at}`");
            self.sink
                .report(Code::Expected, at.extent, &[&example, &found]);
            return None;
        }
        let number = evaluated(&self.system, e);
        if !number.is_finite() {
            self.sink.report(Code::NoValue, at.extent, &[at]);
            return None;
        }
        Some(number)
    }
}

fn evaluated(system: &System, e: ExprId) -> f64 {
    let then = |branch: usize| evaluated(system, system.branches[branch].guard) >= 0.0;
    system.pool.evaluate(&[e], &|_| f64::NAN, &then)[0]
}
