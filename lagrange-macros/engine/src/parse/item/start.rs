//! `start(name: x = e, der(x) = e, theta[k in 0..8] = …, body.turn = [a, b, c])`

use super::super::cursor::Cursor;
use super::super::expression::{index, whole};
use super::super::leftover::leftover;
use super::head;
use crate::ast::{Element, ItemKind, Start, StartQuantity, StartValue};
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::Delimiter;

pub(super) fn start(mut parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let alone = parts.len() == 1;
    let first = parts.first_mut()?;
    let head = head(first, "the name of the start", sink)?;
    if first.is_at_end() && alone {
        return Some(ItemKind::Start(Start {
            head,
            values: Vec::new(),
        }));
    }
    if first.operator() == Some("=") || first.group(Delimiter::Parenthesis).is_some() {
        super::unnamed(&head.name, "start", sink);
        return None;
    }
    if first.operator() != Some(":") {
        super::named(first, "start", sink)?;
    }
    first.require(":", sink)?;
    let values = super::quantity::every(parts, sink, value)?;
    Some(ItemKind::Start(Start { head, values }))
}

/// `x = e`, `der(x) = e` or `body.turn = e`
fn value(part: &mut Cursor, sink: &mut Diagnostics) -> Option<StartValue> {
    let word = part.name(
        "where the run begins: a position `x = …` or a velocity `der(x) = …`",
        sink,
    )?;
    if word.text != "der"
        && let Some(group) = part.group(Delimiter::Parenthesis)
    {
        // `v(theta) = 2` and `theta(0) = 2`: one of both names is a coordinate.
        let inside = part.inside(&group, sink)?.word();
        let of = inside.map_or_else(|| word.text.clone(), |inside| inside.text);
        let what = format!("a position `{of} = …` or a velocity `der({of}) = …`");
        sink.report(
            Code::Expected,
            &word,
            &[&what, &format!("`{}(…)`", word.text)],
        );
        return None;
    }
    let (quantity, name, element) = match part.group(Delimiter::Parenthesis) {
        Some(group) if word.text == "der" => {
            part.next();
            let mut inside = part.inside(&group, sink)?;
            if inside.word().is_some_and(|word| word.text == "der") {
                inside.expected(
                    "a coordinate: a start gives positions `x = …` and velocities `der(x) = …`",
                    sink,
                );
                return None;
            }
            let name = inside.name("a coordinate", sink)?;
            let element = element(&mut inside, sink)?;
            leftover(&mut inside, sink)?;
            (StartQuantity::Velocity, name, element)
        }
        _ => {
            let quantity = match part.take(".") {
                None => StartQuantity::Position,
                Some(_) => StartQuantity::Member(part.name("the name of a member", sink)?),
            };
            (quantity, word, element(part, sink)?)
        }
    };
    part.require("=", sink)?;
    let value = whole(part, sink)?;
    Some(StartValue {
        quantity,
        name,
        element,
        value,
    })
}

/// Nothing, `[2]` or `[k in 0..8]`
fn element(part: &mut Cursor, sink: &mut Diagnostics) -> Option<Element> {
    let Some(group) = part.take_group(Delimiter::Bracket) else {
        return Some(Element::Whole);
    };
    let mut inside = part.inside(&group, sink)?;
    let each = matches!(inside.second(), Some(proc_macro2::TokenTree::Ident(word)) if word == "in");
    if each {
        let index = index(&mut inside, sink)?;
        leftover(&mut inside, sink)?;
        return Some(Element::Each(index));
    }
    Some(Element::One(whole(&mut inside, sink)?))
}
