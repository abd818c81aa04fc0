//! `observe`, `stop`, `mark`.

use super::super::cursor::Cursor;
use super::super::expression::{Advice, comparison, whole};
use super::super::leftover::leftover;
use super::super::relation::{AND, holds_relation};
use super::{head, head_and_colon, no_more, reference};
use crate::ast::{Clause, ItemKind, ModeWord, Observe, Reference, Trigger, Watch};
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::{Delimiter, TokenTree};

/// `height = y, px`
pub(super) fn observe(parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let read = super::quantity::every(parts, sink, |part, sink| {
        if part.second().is_some() && !part.has_operator(&["=", ":"]) {
            let hint = "write `observe(name = …)`";
            sink.report(Code::NoName, part.here(), &[&"output", &hint]);
            return None;
        }
        let head = head(part, "a name", sink)?;
        if part.is_at_end() && head.index.is_none() {
            return Some(Observe::Known(head.name));
        }
        part.require("=", sink)?;
        let value = whole(part, sink)?;
        Some(Observe::New(Box::new(head), value))
    })?;
    Some(ItemKind::Observe(read))
}

/// `name: a >= b and closed(c)`, and for a mark also `name: e`
pub(super) fn watch(
    keyword: &str,
    mut parts: Vec<Cursor>,
    sink: &mut Diagnostics,
) -> Option<ItemKind> {
    let (first, others) = parts.split_first_mut()?;
    let head = head_and_colon(first, keyword, "a name, as in `name: a >= b`", sink)?;
    let trigger = if keyword == "mark" && mode(first).is_none() && !holds_relation(first) {
        Trigger::Zero(whole(first, sink)?)
    } else {
        let example = match keyword {
            "mark" => "`a >= b`, or an expression alone, whose zeros are marked",
            _ => "`a >= b`",
        };
        let advice = (example, AND);
        let mut clauses = vec![clause(first, advice, sink)?];
        while first.take_word("and").is_some() {
            clauses.push(clause(first, advice, sink)?);
        }
        leftover(first, sink)?;
        Trigger::All(clauses)
    };
    no_more(
        others,
        keyword,
        "conditions are joined by `and`; others need an item of their own",
        sink,
    )?;
    let watch = Watch { head, trigger };
    Some(match keyword {
        "stop" => ItemKind::Stop(watch),
        _ => ItemKind::Mark(watch),
    })
}

/// `closed(c)` and the like, if it stands here alone.
fn mode(part: &Cursor) -> Option<ModeWord> {
    let word = part.word()?;
    let called = matches!(part.second(), Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Parenthesis);
    let found = ModeWord::ALL.iter().find(|(text, _)| *text == word.text)?;
    called.then_some(found.1)
}

fn clause(part: &mut Cursor, advice: Advice, sink: &mut Diagnostics) -> Option<Clause> {
    match mode_clause(part, sink) {
        Some(clause) => clause.map(|(word, item)| Clause::Mode(word, item)),
        None => comparison(part, advice, sink).map(Clause::Comparison),
    }
}

/// `closed(c)` and the like; None if something else stands here, Some(None) if it is wrong.
pub(super) fn mode_clause(
    part: &mut Cursor,
    sink: &mut Diagnostics,
) -> Option<Option<(ModeWord, Reference)>> {
    let word = mode(part)?;
    part.next();
    let group = part.take_group(Delimiter::Parenthesis)?;
    let mut item = || {
        let mut inside = part.inside(&group, sink)?;
        let item = reference(&mut inside, "the name of an item", sink)?;
        leftover(&mut inside, sink)?;
        Some((word, item))
    };
    Some(item())
}
