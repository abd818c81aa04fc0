//! Equations, comparisons, and what is left over where a part should have ended.

use super::cursor::Cursor;
use super::expression::{FUNCTIONS, expression};
use super::item::is_keyword;
use crate::ast::{Comparison, Expr, Premise, Relation};
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::{Delimiter, TokenTree};

const RELATIONS: &[&str] = &["==", ">=", "<=", "=", ">", "<", "!="];

/// `left >= right` or `left <= right`. `example` says what to write if there is none.
pub(super) fn comparison(
    cursor: &mut Cursor,
    example: &str,
    sink: &mut Diagnostics,
) -> Option<Comparison> {
    if let Some(mut inside) = invisible(cursor, sink) {
        let found = comparison(&mut inside, example, sink)?;
        leftover(&mut inside, sink)?;
        return Some(found);
    }
    let left = expression(cursor, sink)?;
    let (operator, at) = (cursor.operator(), cursor.here());
    let relation = match operator {
        Some(">=") => Relation::AtLeast,
        Some("<=") => Relation::AtMost,
        Some(strict @ (">" | "<")) => {
            sink.report(Code::StrictComparison, at, &[&strict]);
            return None;
        }
        Some(equal @ ("==" | "=" | "!=")) => {
            let hint = format!("write {example}; equations stand in `constraint`");
            sink.report(Code::WrongRelation, at, &[&equal, &"comparison", &hint]);
            return None;
        }
        _ if cursor.is_at_end() => {
            sink.report(Code::ComparisonExpected, left.extent, &[&example]);
            return None;
        }
        _ => {
            cursor.expected("`>=` or `<=`", sink);
            return None;
        }
    };
    cursor.take(operator.unwrap_or_default());
    let right = expression(cursor, sink)?;
    unchained(cursor, sink)?;
    Some(Comparison {
        left,
        relation,
        right,
    })
}

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
    unchained(cursor, sink)?;
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
        comparison(cursor, "`a >= b` or `a == b`", sink).map(Premise::AtLeast)
    }
}

fn unchained(cursor: &Cursor, sink: &mut Diagnostics) -> Option<()> {
    if cursor
        .operator()
        .is_some_and(|operator| RELATIONS.contains(&operator))
    {
        sink.report(Code::ChainedComparison, cursor.here(), &[]);
        return None;
    }
    Some(())
}

/// Whether a relation is ahead, be it in an invisible group.
pub(super) fn holds_relation(cursor: &Cursor) -> bool {
    match cursor.group(Delimiter::None) {
        Some(group) => Cursor::new(group.stream(), cursor.here(), 0).has_operator(RELATIONS),
        None => cursor.has_operator(RELATIONS),
    }
}

/// An invisible group here that holds a whole relation is entered.
fn invisible(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<Cursor> {
    let inside = cursor.inside(&cursor.group(Delimiter::None)?, sink)?;
    if !inside.has_operator(RELATIONS) {
        return None;
    }
    cursor.next();
    Some(inside)
}

/// Reports what stands where a part should have ended.
pub(super) fn leftover(cursor: &mut Cursor, sink: &mut Diagnostics) -> Option<()> {
    let Some(token) = cursor.peek() else {
        return Some(());
    };
    match (token, cursor.operator()) {
        (_, Some("=")) => cursor.expected("an operator or a comma", sink),
        (_, Some(relation)) if RELATIONS.contains(&relation) => {
            sink.report(Code::ComparisonAsValue, cursor.here(), &[]);
        }
        (_, Some(operator @ ("&&" | "&"))) => {
            sink.report(
                Code::Operator,
                cursor.here(),
                &[&operator, &"conditions are joined by `and`"],
            );
        }
        (_, Some(operator @ ("||" | "|"))) => {
            let hint =
                "an absolute value is written `abs(x)`; alternatives are several `stop` items";
            sink.report(Code::Operator, cursor.here(), &[&operator, &hint]);
        }
        (_, Some(operator @ "%")) => {
            sink.report(
                Code::Operator,
                cursor.here(),
                &[&operator, &"there is no remainder in the language"],
            );
        }
        (_, Some(operator @ ";")) => {
            sink.report(
                Code::Operator,
                cursor.here(),
                &[&operator, &"parts are separated by commas"],
            );
        }
        (TokenTree::Ident(word), _) if starts_part(cursor) => {
            sink.report(Code::MissingComma, word.span(), &[word]);
        }
        (TokenTree::Ident(word), _) if word == "or" => {
            let hint =
                "conditions are joined by `and`; alternatives are several `stop` or `mark` items";
            sink.report(Code::Operator, cursor.here(), &[word, &hint]);
        }
        (TokenTree::Ident(word), _) if word == "as" => {
            let hint = "numbers have no types: leave it away";
            sink.report(Code::RustNotation, cursor.here(), &[word, &hint]);
        }
        (TokenTree::Ident(_) | TokenTree::Literal(_), _) => missing_operator(cursor, sink),
        (TokenTree::Group(group), _) if group.delimiter() == Delimiter::Parenthesis => {
            missing_operator(cursor, sink);
        }
        _ => cursor.expected("an operator or a comma", sink),
    }
    cursor.skip_all();
    None
}

/// Reports a value that follows another one.
fn missing_operator(cursor: &Cursor, sink: &mut Diagnostics) {
    let hint = match cursor.word_behind() {
        Some(word) if FUNCTIONS.contains(&word.text.as_str()) => {
            format!("arguments stand in parentheses: `{}(…)`", word.text)
        }
        _ => "a product is written with `*`".to_string(),
    };
    sink.report(
        Code::MissingOperator,
        cursor.here(),
        &[&cursor.found(), &hint],
    );
}

/// Whether what is here looks like the next part or item.
fn starts_part(cursor: &Cursor) -> bool {
    let Some(word) = cursor.word() else {
        return false;
    };
    match cursor.second() {
        Some(TokenTree::Punct(punct)) => punct.as_char() == '=',
        Some(TokenTree::Group(_)) => is_keyword(&word.text),
        _ => word.text == "where",
    }
}
