//! Equations, and conditions that are equations or comparisons.

use super::cursor::Cursor;
use super::expression::{Advice, comparison, expression, invisible, unchained};
use super::leftover::leftover;
use super::words::RELATIONS;
use crate::ast::{Expr, Premise};
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::{Delimiter, TokenTree};

/// For [`equation`]: what is read, and what to do where another relation stands.
pub(super) const CONSTRAINT: (&str, &str) = (
    "constraint",
    "an equation is written `a == b`; one-sided conditions are contacts: `contact(name: a >= b)`",
);
/// The same for a check.
pub(super) const CHECK: (&str, &str) = (
    "check",
    "what is to be proven is an equation `a == b`; conditions stand behind it: `when a >= b`",
);

/// Two conditions in the place of a chain.
pub(super) const AND: &str = "write two conditions: `a <= x and x <= b`";
/// Of a condition of a check.
const PREMISE: Advice = ("`a >= b` or `a == b`", AND);

/// `left == right` of a constraint or check; `hint` says what to do where another relation stands.
pub(super) fn equation(
    cursor: &mut Cursor,
    (of, hint): (&str, &str),
    sink: &mut Diagnostics,
) -> Option<(Expr, Expr)> {
    if let Some(mut inside) = invisible(cursor, sink) {
        let found = equation(&mut inside, (of, hint), sink)?;
        leftover(&mut inside, sink)?;
        return Some(found);
    }
    let left = expression(cursor, sink)?;
    if let Some(single) = cursor.take("=") {
        sink.report(Code::SingleEquals, single, &[]);
    } else if cursor.take("==").is_none() {
        match cursor.operator() {
            Some(other @ (">=" | "<=" | ">" | "<" | "!=")) => {
                sink.report(Code::WrongRelation, cursor.here(), &[&other, &of, &hint]);
            }
            _ if cursor.is_at_end() => {
                sink.report(
                    Code::Expected,
                    left.extent,
                    &[&"an equation `a == b`", &"a value"],
                );
            }
            _ => cursor.expected("`==`", sink),
        }
        return None;
    }
    let right = expression(cursor, sink)?;
    unchained(cursor, "write an equation for each", sink)?;
    Some((left, right))
}

/// `left == right`, `left >= right` or `left <= right`.
pub(super) fn equation_or_comparison(
    cursor: &mut Cursor,
    sink: &mut Diagnostics,
) -> Option<Premise> {
    let is_equation = match cursor.group(Delimiter::None) {
        Some(group) => Cursor::new(group.stream(), cursor.here(), 0).has_operator(&["=="]),
        None => {
            // Only up to the next condition.
            let mut ahead = cursor.clone();
            let mut found = false;
            while let Some(token) = ahead.peek() {
                found |= ahead.operator() == Some("==");
                if matches!(token, TokenTree::Ident(word) if *word == "and") {
                    break;
                }
                ahead.next();
            }
            found
        }
    };
    if is_equation {
        equation(cursor, CHECK, sink).map(|(left, right)| Premise::Equal(left, right))
    } else {
        comparison(cursor, PREMISE, sink).map(Premise::AtLeast)
    }
}

/// Whether a relation is ahead, be it in an invisible group.
pub(super) fn holds_relation(cursor: &Cursor) -> bool {
    match cursor.group(Delimiter::None) {
        Some(group) => Cursor::new(group.stream(), cursor.here(), 0).has_operator(RELATIONS),
        None => cursor.has_operator(RELATIONS),
    }
}
