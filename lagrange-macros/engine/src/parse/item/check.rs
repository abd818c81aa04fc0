//! `check`: `name: a == b when closed(c) and u >= w`, `conserved e when …`.

use super::super::cursor::Cursor;
use super::super::expression::expression;
use super::super::leftover::leftover;
use super::super::relation::{CHECK, equation, equation_or_comparison};
use super::output::mode_clause;
use super::{head, no_more};
use crate::ast::{Check, Claim, ItemKind, Premise};
use crate::diagnostics::{Code, Diagnostics, Extent};
use proc_macro2::{Delimiter, TokenTree};

/// The word before a quantity that is claimed to stay; no name is called so.
const CONSERVED: &str = "conserved";

/// `name: a == b when …`, name and condition as the user likes.
pub(super) fn check(mut parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let (first, others) = parts.split_first_mut()?;
    let head = match is_named(first) {
        false => None,
        true => {
            let head = head(first, "a name", sink)?;
            first.require(":", sink)?;
            Some(head)
        }
    };
    let start = first.here();
    let claim = claim(first, sink)?;
    let claimed = Extent::new(start, first.behind());
    let mut premises = Vec::new();
    if first.take_word("when").is_some() {
        premises.push(premise(first, sink)?);
        while first.take_word("and").is_some() {
            premises.push(premise(first, sink)?);
        }
    }
    let other = |word: &str| matches!(word, "while" | "if" | "where" | "for");
    if premises.is_empty() && first.word().is_some_and(|word| other(&word.text)) {
        first.expected("`when`", sink);
        return None;
    }
    leftover(first, sink)?;
    no_more(others, "check", "write an item for each check", sink)?;
    Some(ItemKind::Check(Box::new(Check {
        head,
        claim,
        claimed,
        premises,
    })))
}

/// Whether `name:` or `name[…]:` is ahead.
fn is_named(part: &Cursor) -> bool {
    let colon = |token: Option<TokenTree>| matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == ':');
    if part.word().is_none_or(|word| word.text == CONSERVED) {
        return false;
    }
    let mut ahead = part.clone();
    ahead.next();
    ahead.take_group(Delimiter::Bracket);
    colon(ahead.next())
}

fn claim(part: &mut Cursor, sink: &mut Diagnostics) -> Option<Claim> {
    if part.take_word(CONSERVED).is_some() {
        if let Some(colon) = part.take(":") {
            let hint = "`conserved` is no name: write `conserved energy`, or with a name `name: conserved energy`";
            sink.report(Code::Misplaced, colon, &[&":", &hint]);
            part.skip_all();
            return None;
        }
        return expression(part, sink).map(Claim::Conserved);
    }
    if let Some(word) = conserved_behind(part) {
        let hint = "the word stands before the quantity: `conserved energy`";
        sink.report(Code::Misplaced, word, &[&CONSERVED, &hint]);
        part.skip_all();
        return None;
    }
    equation(part, CHECK, sink).map(|(left, right)| Claim::Equal(left, right))
}

/// The word `conserved` behind a quantity, where English has it.
fn conserved_behind(part: &Cursor) -> Option<Extent> {
    let mut ahead = part.clone();
    ahead.next();
    while !ahead.is_at_end() && ahead.operator().is_none() {
        if ahead.word().is_some_and(|word| word.text == CONSERVED) {
            return Some(ahead.here());
        }
        ahead.next();
    }
    None
}

fn premise(part: &mut Cursor, sink: &mut Diagnostics) -> Option<Premise> {
    match mode_clause(part, sink) {
        Some(clause) => clause.map(|(word, item)| Premise::Mode(word, item)),
        None => equation_or_comparison(part, sink),
    }
}
