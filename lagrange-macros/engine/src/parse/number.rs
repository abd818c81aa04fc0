//! Literals → exact decimal numbers: `12`, `0.5`, `2.`, `1e-3`, `1_000`.

use super::words::{DEGREES, is_degree};
use crate::ast::Decimal;
use crate::diagnostics::{Code, Diagnostics};
use proc_macro2::Literal;

/// Reads a numeric literal; anything else is reported.
pub(super) fn number(literal: &Literal, sink: &mut Diagnostics) -> Option<Decimal> {
    let text = literal.to_string();
    let plain: String = text.chars().filter(|&c| c != '_').collect();
    let split = suffix_start(&plain);
    let (digits, suffix) = plain.split_at(split);
    if text.starts_with('"') {
        let hint = "write the expression without quotation marks; only units have them";
        sink.report(Code::RustNotation, literal.span(), &[&text, &hint]);
        return None;
    }
    if digits.is_empty() || (digits == "0" && suffix.starts_with(['x', 'b', 'o'])) {
        sink.report(Code::NumberForm, literal.span(), &[&text]);
        return None;
    }
    if !suffix.is_empty() {
        let hint = match suffix {
            "f64" | "f32" | "i32" | "u32" | "i64" | "u64" | "usize" | "isize" => {
                format!("numbers are exact and have no type: write `{digits}`")
            }
            degrees if is_degree(degrees) => DEGREES.to_owned(),
            _ => format!("a product is written with `*`: `{digits}*{suffix}`"),
        };
        sink.report(Code::NumberSuffix, literal.span(), &[&text, &hint]);
        return None;
    }
    let value = decimal(digits);
    if value.is_none() {
        sink.report(Code::NumberSize, literal.span(), &[&text]);
    }
    value
}

/// Where what is not part of the number begins.
fn suffix_start(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut i: usize| {
        while i < bytes.len() && bytes[i].is_ascii_digit() {
            i += 1;
        }
        i
    };
    let mut i = digits(0);
    if i > 0 && bytes.get(i) == Some(&b'.') {
        i = digits(i + 1);
    }
    if i > 0 && matches!(bytes.get(i), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(i + 1), Some(b'+' | b'-')));
        let end = digits(i + 1 + sign);
        if end > i + 1 + sign {
            i = end;
        }
    }
    i
}

/// `text` is digits with at most one point and one exponent.
fn decimal(text: &str) -> Option<Decimal> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let part = part.trim_end_matches('0');
    let digits: i128 = format!("{whole}{part}").parse().ok()?;
    let exponent = exponent.checked_sub(i32::try_from(part.len()).ok()?)?;
    if digits == 0 {
        return Some(Decimal {
            digits: 0,
            exponent: 0,
        });
    }
    // A double that is neither 0 nor infinite; whether it can be kept exactly is asked where it must be.
    let number = Decimal { digits, exponent };
    (number.nearest().is_finite() && number.nearest() != 0.0).then_some(number)
}
