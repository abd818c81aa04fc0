//! What is left over where a part should have ended.

use super::cursor::Cursor;
use super::words::{DEGREES, FUNCTIONS, RELATIONS, is_degree, is_keyword};
use crate::ast::ModeWord;
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::{Delimiter, TokenTree};

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
        (_, Some(operator @ ",")) => {
            let hint = "one index stands here: arrays have one, and an item has one for each value of another, `contact(first[j in 1..4]: …)`";
            sink.report(Code::Operator, cursor.here(), &[&operator, &hint]);
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
        (TokenTree::Ident(word), _) if word == "and" => {
            let hint = "one condition stands here: write a contact for each gap, and `if(a, if(b, x, y), y)` instead of `if(a and b, x, y)`";
            sink.report(Code::Operator, cursor.here(), &[word, &hint]);
        }
        (TokenTree::Ident(word), _) if word == "while" => {
            let hint = "it stands behind the name of a constraint, `constraint(name while contact: a == b)`; a contact has a region, `, where c >= d`";
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
        _ if cursor.word().is_some_and(|word| is_mode(&word.text)) => {
            "the mode in which a check holds stands behind `when`: `check(floor == m*g when closed(floor))`"
                .to_string()
        }
        None if cursor.literal_behind()
            && cursor.word().is_some_and(|word| is_degree(&word.text)) =>
        {
            DEGREES.to_string()
        }
        None if cursor.literal_behind() && cursor.word().is_some() => {
            let what = "a product is written with `*`; what has a unit is a parameter, and an angle a plain number";
            what.to_string()
        }
        _ => "a product is written with `*`".to_string(),
    };
    sink.report(
        Code::MissingOperator,
        cursor.here(),
        &[&cursor.found(), &hint],
    );
}

/// Whether a word tells of a mode, `closed`.
fn is_mode(word: &str) -> bool {
    ModeWord::ALL.iter().any(|(text, _)| *text == word)
}

/// Whether what is here looks like the next part or item.
fn starts_part(cursor: &Cursor) -> bool {
    let Some(word) = cursor.word() else {
        return false;
    };
    let mut behind = cursor.clone();
    behind.next();
    let is_group = matches!(behind.peek(), Some(TokenTree::Group(_)));
    if is_group {
        behind.next();
    }
    matches!(behind.operator(), Some("=" | ":"))
        || is_group && is_keyword(&word.text)
        || word.text == "where" && !is_group
}
