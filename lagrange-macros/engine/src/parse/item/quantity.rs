//! `coordinates`, `define`, `kinetic`, `potential`, `dissipation`.

use super::super::cursor::Cursor;
use super::super::expression::{expression, whole};
use super::super::leftover::leftover;
use super::{head, head_and_colon, no_more, text};
use crate::ast::{Coordinate, Definition, Dissipation, Energy, Expr, ItemKind, Unit};
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::Delimiter;

/// Reads every part; nothing if any of them is wrong.
pub(super) fn every<R>(
    parts: Vec<Cursor>,
    sink: &mut Diagnostics,
    read: impl Fn(&mut Cursor, &mut Diagnostics) -> Option<R>,
) -> Option<Vec<R>> {
    let read: Vec<Option<R>> = parts
        .into_iter()
        .map(|mut part| read(&mut part, sink))
        .collect();
    read.into_iter().collect()
}

/// `x, r: "m", theta[8]`
pub(super) fn coordinates(parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let read = every(parts, sink, |part, sink| {
        let name = part.name("the name of a coordinate", sink)?;
        let length = match part.take_group(Delimiter::Bracket) {
            None => None,
            Some(group) => Some(whole(&mut part.inside(&group, sink)?, sink)?),
        };
        let unit = match part.take(":") {
            None => None,
            Some(_) => {
                let extent = part.here();
                let text = text(part, "a unit, as in `x: \"m\"`", sink)?;
                Some(Unit { text, extent })
            }
        };
        if let Some(next) = part.word() {
            sink.report(Code::MissingComma, &next, &[&next.text]);
            return None;
        }
        if part.group(Delimiter::Bracket).is_some() {
            let hint = "coordinates have one index: a name for each row, `x[3], y[3]`, or one for all, `x[6]`";
            sink.report(Code::Misplaced, part.here(), &[&"[…]", &hint]);
            return None;
        }
        leftover(part, sink)?;
        Some(Coordinate { name, length, unit })
    })?;
    Some(ItemKind::Coordinates(read))
}

/// `px = …, p[k in 0..8] = …`
pub(super) fn define(parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let read = every(parts, sink, |part, sink| {
        let head = head(part, "a name", sink)?;
        if part.group(Delimiter::Parenthesis).is_some() {
            sink.report(Code::FunctionDefined, &head.name, &[&head.name.text]);
            return None;
        }
        part.require("=", sink)?;
        let value = whole(part, sink)?;
        Some(Definition { head, value })
    })?;
    Some(ItemKind::Define(read))
}

/// `kinetic = …`, `potential = …`, `lagrangian = …`
pub(super) fn unnamed_energy(keyword: &str, value: Expr) -> ItemKind {
    match keyword {
        "kinetic" => ItemKind::Kinetic(Energy { head: None, value }),
        "potential" => ItemKind::Potential(Energy { head: None, value }),
        _ => ItemKind::Lagrangian(value),
    }
}

/// `name: …`
pub(super) fn named_energy(
    keyword: &str,
    mut parts: Vec<Cursor>,
    sink: &mut Diagnostics,
) -> Option<ItemKind> {
    let (first, others) = parts.split_first_mut()?;
    let head = head_and_colon(first, keyword, "a name, as in `name: …`", sink)?;
    let value = expression(first, sink)?;
    if let Some(equals) = first.take("=") {
        let hint = "what stands here is one value; a force along a coordinate is an item of its own, `force(name: x = …)`";
        sink.report(Code::Operator, equals, &[&"=", &hint]);
        return None;
    }
    leftover(first, sink)?;
    no_more(others, keyword, "write an item for each term", sink)?;
    Some(match keyword {
        "dissipation" => ItemKind::Dissipation(Dissipation { head, value }),
        "kinetic" => ItemKind::Kinetic(Energy {
            head: Some(head),
            value,
        }),
        _ => ItemKind::Potential(Energy {
            head: Some(head),
            value,
        }),
    })
}
