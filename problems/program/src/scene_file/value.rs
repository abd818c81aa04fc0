//! A value of a scene file as the type that it should have, or what to write instead.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value with its place.
pub(super) type Value<'t> = Spanned<DeValue<'t>>;

/// What is wrong, and at which byte.
pub(super) type Wrong = (usize, String);

fn wrong<T>(value: &Value, expected: &str) -> Result<T, Wrong> {
    let found = match value.get_ref() {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "true or false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    };
    let reason = format!("{expected} is expected here, not {found}");
    Err((value.span().start, reason))
}

/// A finite number.
pub(super) fn number(value: &Value) -> Result<f64, Wrong> {
    let digits = |text: &str| text.replace('_', "");
    let found = match value.get_ref() {
        DeValue::Integer(number) if number.radix() != 10 => {
            let reason = "numbers are written in decimal digits".to_owned();
            return Err((value.span().start, reason));
        }
        DeValue::Integer(number) => digits(number.as_str()).parse().ok(),
        DeValue::Float(number) => digits(number.as_str()).parse().ok(),
        DeValue::String(text) if text.trim().parse::<f64>().is_ok() => {
            return wrong(value, "a number, without quotes,");
        }
        _ => None,
    };
    match found {
        None => wrong(value, "a number"),
        Some(number) if f64::is_finite(number) => Ok(number),
        Some(_) => Err((value.span().start, "the value must be finite".to_owned())),
    }
}

/// A finite number above 0.
pub(super) fn positive(value: &Value) -> Result<f64, Wrong> {
    match number(value)? {
        number if number > 0.0 => Ok(number),
        _ => Err((value.span().start, "the value must be above 0".to_owned())),
    }
}

/// `true` or `false`.
pub(super) fn flag(value: &Value) -> Result<bool, Wrong> {
    match value.get_ref() {
        DeValue::Boolean(flag) => Ok(*flag),
        DeValue::String(_) => wrong(value, "true or false, without quotes,"),
        _ => wrong(value, "true or false"),
    }
}

/// A text in quotes.
pub(super) fn text<'v>(value: &'v Value) -> Result<&'v str, Wrong> {
    match value.get_ref() {
        DeValue::String(text) => Ok(text),
        _ => wrong(value, "a text in quotes"),
    }
}

/// A text, or a list of texts; with the places of all.
pub(super) fn texts<'v>(value: &'v Value) -> Result<Vec<(usize, &'v str)>, Wrong> {
    let one = |value: &'v Value| Ok((value.span().start, text(value)?));
    match value.get_ref() {
        DeValue::Array(list) => list.iter().map(one).collect(),
        DeValue::String(_) => Ok(vec![one(value)?]),
        _ => wrong(value, "a text in quotes, or a list of them,"),
    }
}

/// A table.
pub(super) fn table<'v, 't>(value: &'v Value<'t>) -> Result<&'v DeTable<'t>, Wrong> {
    match value.get_ref() {
        DeValue::Table(table) => Ok(table),
        _ => wrong(value, "a table"),
    }
}
