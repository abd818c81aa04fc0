//! `force`: generalized, at a point, or along a velocity.

use super::super::cursor::Cursor;
use super::super::expression::{expression, whole};
use super::{head_and_colon, no_more};
use crate::ast::{Action, Expr, Force, ItemKind, Reference};
use crate::diagnostics::{Code, Diagnostics};

/// `name: theta = τ`, `name: (fx, fy) at (px, py)` or `name: f along s`
pub(super) fn force(mut parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let (first, others) = parts.split_first_mut()?;
    let head = head_and_colon(first, "force", "the name of the force", sink)?;
    let value = expression(first, sink)?;
    let action = if first.take_word("at").is_some() {
        Action::At(value, whole(first, sink)?)
    } else if first.take_word("along").is_some() {
        Action::Along(value, whole(first, sink)?)
    } else if first.take("=").is_some() {
        Action::Generalized(coordinate(value, sink)?, whole(first, sink)?)
    } else {
        let what = "`x = f` with a coordinate x, `(fx, fy) at (px, py)`, or `f along s`";
        if first.is_at_end() {
            sink.report(Code::Expected, value.extent, &[&what, &"a value"]);
        } else {
            first.expected("`=`, `at` or `along`", sink);
        }
        return None;
    };
    no_more(others, "force", "write an item for each force", sink)?;
    Some(ItemKind::Force(Box::new(Force { head, action })))
}

/// A coordinate, read as an expression.
fn coordinate(value: Expr, sink: &mut Diagnostics) -> Option<Reference> {
    let found = value.as_reference();
    if found.is_none() {
        sink.report(
            Code::Expected,
            value.extent,
            &[&"a coordinate before `=`", &format!("`{value}`")],
        );
    }
    found
}
