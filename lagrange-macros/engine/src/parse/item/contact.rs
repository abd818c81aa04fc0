//! `constraint`, `contact`, `friction`.

use super::super::cursor::Cursor;
use super::super::expression::{Advice, comparison, expression, whole};
use super::super::leftover::leftover;
use super::super::relation::{CONSTRAINT, equation};
use super::{head, head_and_colon, key, named, no_more, once, reference};
use crate::ast::{
    Comparison, Constraint, Contact, Expr, Friction, FrictionLaw, Head, ItemKind, Name, Reference,
    Restitution,
};
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::Delimiter;

const GAP: Advice = ("`gap >= 0`", "write a contact for each");
const REGION: Advice = (
    "`where c >= d`",
    "a region is one comparison: for `a <= x <= b` write `where min(x - a, b - x) >= 0`",
);

/// `name: a == b` or `name while contact: a == b`
pub(super) fn constraint(mut parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let (first, others) = parts.split_first_mut()?;
    named(first, "constraint", sink)?;
    let head = head(first, "the name of the constraint", sink)?;
    let while_contact = match first.take_word("while") {
        None => None,
        Some(word) => Some((
            word.span(),
            reference(first, "the name of a contact", sink)?,
        )),
    };
    first.require(":", sink)?;
    let sides = equation(first, CONSTRAINT, sink).and_then(|sides| {
        if let Some(and) = first.take_word("and") {
            let hint = "a constraint is one equation: write a constraint for each";
            sink.report(Code::Operator, &and, &[&and.text, &hint]);
            return None;
        }
        leftover(first, sink)?;
        Some(sides)
    });
    no_more(others, "constraint", "a constraint is one equation", sink)?;
    let (left, right) = sides?;
    Some(ItemKind::Constraint(Box::new(Constraint {
        head,
        while_contact,
        left,
        right,
    })))
}

/// `name: a >= b at p, restitution = e, where c >= d`
pub(super) fn contact(mut parts: Vec<Cursor>, sink: &mut Diagnostics) -> Option<ItemKind> {
    let (first, others) = parts.split_first_mut()?;
    let head = head_and_colon(first, "contact", "the name of the contact", sink)?;
    let gap = gap(first, sink);
    let (mut restitution, mut region) = (None, None);
    for part in others {
        contact_part(part, &mut restitution, &mut region, sink);
    }
    let (gap, at) = gap?;
    Some(ItemKind::Contact(Box::new(Contact {
        head,
        gap,
        at,
        restitution,
        region,
    })))
}

/// `a >= b at p`
fn gap(
    part: &mut Cursor,
    sink: &mut Diagnostics,
) -> Option<(Comparison, Option<crate::ast::Expr>)> {
    let gap = comparison(part, GAP, sink)?;
    let at = match part.take_word("at") {
        None => None,
        Some(_) => Some(expression(part, sink)?),
    };
    leftover(part, sink)?;
    Some((gap, at))
}

fn contact_part(
    part: &mut Cursor,
    restitution: &mut Option<Restitution>,
    region: &mut Option<Comparison>,
    sink: &mut Diagnostics,
) -> Option<()> {
    if let Some(word) = part.take_word("where") {
        let found = comparison(part, REGION, sink)?;
        let hint = "a region is one comparison; for two write `where min(a, b) >= 0`";
        if region.is_some() {
            sink.report(Code::RepeatedPart, &word, &[&word.text, &hint]);
        }
        *region = Some(found);
        if let Some(and) = part.take_word("and") {
            sink.report(Code::Operator, &and, &[&and.text, &hint]);
            part.skip_all();
            return None;
        }
    } else {
        let key = key(part, "contact", &["restitution", "where"], sink)?;
        let found = match part.take_word("poisson") {
            None => Restitution::Newton(expression(part, sink)?),
            Some(poisson) => match part.take_group(Delimiter::Parenthesis) {
                Some(group) => {
                    let inside = part.inside(&group, sink)?;
                    let mut arguments = inside.parts("a coefficient", sink);
                    let [e] = arguments.as_mut_slice() else {
                        let count = arguments.len();
                        sink.report(
                            Code::ArgumentCount,
                            &poisson,
                            &[&poisson.text, &"1 argument", &count],
                        );
                        return None;
                    };
                    Restitution::Poisson(whole(e, sink)?)
                }
                None => {
                    part.expected("`(`, as in `poisson(e)`", sink);
                    return None;
                }
            },
        };
        once(restitution, found, &key, sink);
    }
    leftover(part, sink)
}

/// `name on item: slip = …, static = …, kinetic = …`
pub(super) fn friction(
    keyword: &Name,
    mut parts: Vec<Cursor>,
    sink: &mut Diagnostics,
) -> Option<ItemKind> {
    let before = sink.count();
    let first = parts.first_mut()?;
    named(first, "friction", sink)?;
    let head = head(first, "the name of the friction", sink)?;
    let on = match first.take_word("on") {
        None => Vec::new(),
        Some(_) => bearers(first, sink)?,
    };
    first.require(":", sink)?;
    let mut given = Given::default();
    for part in &mut parts {
        let keys = ["slip", "static", "kinetic", "normal", "limit"];
        let Some(key) = key(part, "friction", &keys, sink) else {
            continue;
        };
        let Some(value) = whole(part, sink) else {
            continue;
        };
        let slot = match key.text.as_str() {
            "slip" => &mut given.slip,
            "static" => &mut given.stick,
            "kinetic" => &mut given.slide,
            "normal" => &mut given.normal,
            _ => &mut given.limit,
        };
        once(slot, value, &key, sink);
    }
    if sink.count() > before {
        return None;
    }
    let slip = given.slip.take();
    if slip.is_none() {
        missing(&head, "slip velocity", "slip = …", sink);
    }
    let law = law(keyword, &head, on.first(), given, sink);
    let (slip, law) = (slip?, law?);
    (sink.count() == before).then_some(ItemKind::Friction(Box::new(Friction {
        head,
        on,
        slip,
        law,
    })))
}

/// What presses: `rim`, or the constraints of a bearing together, `(pin_x, pin_y)`.
fn bearers(part: &mut Cursor, sink: &mut Diagnostics) -> Option<Vec<Reference>> {
    let what = "the name of a contact or constraint";
    let Some(group) = part.take_group(Delimiter::Parenthesis) else {
        return Some(vec![reference(part, what, sink)?]);
    };
    let inside = part.inside(&group, sink)?;
    if inside.is_at_end() {
        inside.expected(what, sink);
        return None;
    }
    let names = inside.parts(what, sink).into_iter().map(|mut name| {
        let reference = reference(&mut name, what, sink)?;
        leftover(&mut name, sink)?;
        Some(reference)
    });
    names.collect()
}

/// Parts of a friction, by their keys.
#[derive(Default)]
struct Given {
    slip: Option<Expr>,
    stick: Option<Expr>,
    slide: Option<Expr>,
    normal: Option<Expr>,
    limit: Option<Expr>,
}

/// `static` with a source of the normal force, or `limit` alone.
fn law(
    keyword: &Name,
    head: &Head,
    on: Option<&Reference>,
    given: Given,
    sink: &mut Diagnostics,
) -> Option<FrictionLaw> {
    match (given.limit, given.stick) {
        (Some(limit), None) if given.slide.is_none() && given.normal.is_none() && on.is_none() => {
            Some(FrictionLaw::Limit(limit))
        }
        (Some(_), _) => {
            let hint = "`limit` is the whole friction force; `static`, `kinetic` and `normal`, or `on`, make another";
            sink.report(Code::Exclusive, keyword, &[&"limit", &"static", &hint]);
            None
        }
        (None, Some(stick)) => {
            match (on, &given.normal) {
                (None, None) => {
                    missing(head, "normal force", "on contact` or `normal = N", sink);
                }
                (Some(on), Some(_)) => {
                    let hint = "keep one source of the normal force";
                    sink.report(Code::Exclusive, &on.name, &[&"on", &"normal", &hint]);
                }
                _ => {}
            }
            Some(FrictionLaw::Coefficients {
                normal: given.normal.map(Box::new),
                stick: Box::new(stick),
                slide: given.slide.map(Box::new),
            })
        }
        (None, None) => {
            missing(head, "coefficient", "static = mu", sink);
            None
        }
    }
}

fn missing(head: &Head, what: &str, part: &str, sink: &mut Diagnostics) {
    sink.report(
        Code::MissingPart,
        &head.name,
        &[&head.name.text, &what, &part],
    );
}
