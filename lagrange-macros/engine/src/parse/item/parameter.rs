//! What only a declaration in a file has: `parameters(mass: "kg" positive = 1, length[3] = 0.5)` in the place of the fields of a struct, and
//! `until = 20`, the time at which a run ends.

use super::super::cursor::Cursor;
use super::super::expression::{expression, whole};
use super::super::leftover::leftover;
use super::super::number::number;
use super::super::structure;
use super::super::words::{NO_FIELDS, is_degree};
use super::quantity::every;
use super::{once, text};
use crate::ast::{Expr, ExprKind, Field, Name, Unit};
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use syn::Attribute;
use syn::parse::Parser;

/// What has been read of it.
#[derive(Default)]
pub(in crate::parse) struct Parameters {
    /// Parameters with their values.
    pub fields: Vec<(Field, Expr)>,
    /// Time at which a run ends, s.
    pub until: Option<Expr>,
}

impl Parameters {
    /// Reads an item behind its keyword.
    pub(super) fn read(
        &mut self,
        keyword: &Name,
        part: &mut Cursor,
        sink: &mut Diagnostics,
    ) -> Option<()> {
        if keyword.text == "until" {
            if part.require("=", sink).is_none() {
                part.skip_all();
                return None;
            }
            if let Some(unit) = unit_of_time(part) {
                unit.expected(
                    "a number of seconds without a unit, as in `until = 10`",
                    sink,
                );
                part.skip_all();
                return None;
            }
            once(&mut self.until, whole(part, sink)?, keyword, sink);
            return Some(());
        }
        let Some(group) = part.take_group(Delimiter::Parenthesis) else {
            part.expected("`(`", sink);
            part.skip_all();
            return None;
        };
        let inside = part.inside(&group, sink)?;
        let example = "parameters, as in `parameters(mass: \"kg\" = 1)`";
        self.fields
            .extend(every(inside.parts(example, sink), sink, parameter)?);
        Some(())
    }
}

/// Where a time has a unit, `10s`, `10 s`, `10 "s"` or `"10 s"`: at the number, if the unit is in one token with it.
fn unit_of_time(part: &Cursor) -> Option<Cursor> {
    let mut behind = part.clone();
    let Some(TokenTree::Literal(number)) = behind.next() else {
        return None;
    };
    let inside = number
        .to_string()
        .ends_with(|c: char| c.is_alphabetic() || c == '"');
    let follows = matches!(
        behind.peek(),
        Some(TokenTree::Ident(_) | TokenTree::Literal(_))
    );
    match inside {
        true => Some(part.clone()),
        false => follows.then_some(behind),
    }
}

/// `mass = 1`, `mass: "kg" = 1`, `mass: "kg" positive = 1`, `length[3]: "m" = 1`, `length: "m" = [1, 2, 3]`, with attributes of a field
/// before it.
fn parameter(part: &mut Cursor, sink: &mut Diagnostics) -> Option<(Field, Expr)> {
    let attributes = attributes(part, sink)?;
    let name = match part.peek() {
        Some(TokenTree::Literal(_)) => "the name of a parameter (a decimal has a point: `0.5`)",
        _ => "the name of a parameter",
    };
    let name = part.name(name, sink)?;
    if NO_FIELDS.contains(&name.text.as_str()) {
        sink.report(Code::NoField, &name, &[&name.text]);
    }
    let length = match part.take_group(Delimiter::Bracket) {
        None => None,
        Some(group) => Some(length(&mut part.inside(&group, sink)?, sink)?),
    };
    let mut field = structure::described(name, length, &attributes, sink);
    if let Some(colon) = part.take(":") {
        let extent = part.here();
        let what = match part.word().filter(|word| structure::is_domain(&word.text)) {
            Some(word) => format!(
                "a unit; without one write `{} {}`",
                field.name.text, word.text
            ),
            None => "a unit, as in `mass: \"kg\" = 1`".to_owned(),
        };
        let text = text(part, &what, sink)?;
        if field.unit.is_some() {
            sink.report(Code::RepeatedPart, colon, &[&"unit", &"keep one"]);
        }
        field.unit = Some(Unit { text, extent });
    }
    if let Some(word) = part.word() {
        part.next();
        if field.domain.is_some() {
            sink.report(Code::RepeatedPart, &word, &[&"domain", &"keep one"]);
        }
        field.domain = Some(structure::domain(&word.text, (&word).into(), sink)?);
    }
    if part.is_at_end() {
        let (name, text) = (&field.name, &field.name.text);
        sink.report(Code::MissingPart, name, &[text, &"value", &"= 1"]);
        return None;
    }
    part.require("=", sink)?;
    let value = expression(part, sink)?;
    if let Some(behind) = unit_behind(part) {
        let name = &field.name.text;
        let right = match structure::is_domain(&behind) {
            true => format!("a domain stands before the value: `{name} {behind} = {value}`"),
            false => format!("a unit stands before the value: `{name}: \"{behind}\" = {value}`"),
        };
        sink.report(Code::Misplaced, part.here(), &[&behind, &right]);
        part.skip_all();
        return None;
    }
    leftover(part, sink)?;
    if let ExprKind::List(elements) = &value.kind {
        field.length.get_or_insert(elements.len());
    }
    Some((field, value))
}

/// What stands behind a value as its unit would in a text, `1 "kg"`, `9.81 m/s^2`, or its domain, `1 positive`.
fn unit_behind(part: &Cursor) -> Option<String> {
    let unit = match part.peek()? {
        TokenTree::Literal(literal) => syn::parse_str::<syn::LitStr>(&literal.to_string())
            .ok()?
            .value(),
        TokenTree::Ident(word) if part.literal_behind() && !is_degree(&word.to_string()) => {
            let goes_on = |token: &TokenTree| match token {
                TokenTree::Punct(punct) => "/*^".contains(punct.as_char()),
                _ => false,
            };
            if !part.second().is_none_or(goes_on) {
                return None;
            }
            let tokens = part.clone().rest().into_iter();
            tokens.map(|token| token.to_string()).collect()
        }
        _ => return None,
    };
    Some(unit)
}

/// The number N of `[N]`.
fn length(inside: &mut Cursor, sink: &mut Diagnostics) -> Option<usize> {
    let here = inside.here();
    let found = inside.found();
    let length = match inside.next() {
        Some(TokenTree::Literal(literal)) => Some(number(&literal, sink)?),
        _ => None,
    };
    let length = length.filter(|length| length.exponent == 0 && inside.is_at_end());
    let length = length.and_then(|length| usize::try_from(length.digits).ok());
    if length.is_none() {
        let wanted = "a number of elements, as in `[3]`, or a unit, as in `: \"m\"`";
        sink.report(Code::Expected, here, &[&wanted, &found]);
    }
    length
}

/// Attributes and doc comments here, outer and inner, as the attributes of an item.
pub(in crate::parse) fn attributes(
    part: &mut Cursor,
    sink: &mut Diagnostics,
) -> Option<Vec<Attribute>> {
    let mut tokens = TokenStream::new();
    // A remark of another language begins so, too.
    let begins = |part: &Cursor| {
        let behind = part.second();
        let inner = matches!(&behind, Some(TokenTree::Punct(punct)) if punct.as_char() == '!');
        part.operator() == Some("#") && (inner || matches!(behind, Some(TokenTree::Group(_))))
    };
    while begins(part) {
        tokens.extend(part.next());
        part.take("!");
        tokens.extend(part.take_group(Delimiter::Bracket).map(TokenTree::from));
    }
    let attributes = Attribute::parse_outer.parse2(tokens);
    attributes.map_err(|error| sink.absorb(error)).ok()
}
