//! Numbers as people write them: `1e-3`, `pi/3`; counts `400`, `1e6`; and as they are shown.

use lagrange_engine::diagnostics::Diagnostics;

/// To six significant digits: no picture shows more. What is not finite is 0: JSON cannot hold it.
pub(crate) fn significant(x: f64) -> f64 {
    if !x.is_finite() || x == 0.0 {
        return 0.0;
    }
    format!("{x:.5e}").parse().unwrap_or(0.0)
}

/// The digits of a number without zeros behind the point that say nothing.
pub(crate) fn without_zeros(digits: &str) -> &str {
    match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => digits,
    }
}

/// A finite number, or an expression that is one.
///
/// # Errors
/// It is something else: what to say about it.
pub fn finite(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let number = match text.parse::<f64>() {
        Ok(number) => number,
        Err(_) => lagrange_engine::number(text).map_err(|mistakes| match has_unit(text) {
            true => format!("`{text}` is not a number: {WITHOUT_UNIT}"),
            false => why_not(text, &mistakes),
        })?,
    };
    match number.is_finite() {
        true => Ok(number),
        false => Err("the value must be finite".to_owned()),
    }
}

/// What is said of `3s` and `2 kg`.
const WITHOUT_UNIT: &str = "a value is a plain number, in the unit in which its parameter or coordinate is declared, and of a time in s; \
     write it without a unit";

/// Whether a text is a number with letters behind it that are none themselves, as those of `2pi` are.
fn has_unit(text: &str) -> bool {
    let digits = |c: char| c.is_ascii_digit() || "+-.".contains(c);
    let rest = text.trim_start_matches(digits);
    let exponent = rest.strip_prefix(['e', 'E']);
    let exponent = exponent.map(|rest| (rest, rest.trim_start_matches(digits)));
    let rest = match exponent {
        Some((all, rest)) if rest.len() < all.len() => rest,
        _ => rest,
    };
    // Degrees are told how they are written.
    let unit = rest.trim_start();
    rest.len() < text.len()
        && unit.starts_with(char::is_alphabetic)
        && !unit.starts_with("deg")
        && lagrange_engine::number(unit).is_err()
}

/// That a text is not a number, and by which mistake.
fn why_not(text: &str, mistakes: &Diagnostics) -> String {
    let told = format!("`{text}` is not a number");
    let first = mistakes.iter().take(1);
    let parts = first.flat_map(|mistake| [&mistake.message, &mistake.hint]);
    let parts = parts.filter(|part| !part.is_empty() && **part != told);
    let why: Vec<&str> = parts.map(String::as_str).collect();
    format!("{told}: {}", why.join("; "))
}

/// A whole number from 1, also in the notation `1e6`; what is beyond a `usize` becomes the largest one.
pub fn count(text: &str) -> Option<usize> {
    let text = text.trim();
    if let Ok(count) = text.parse::<usize>() {
        return (count > 0).then_some(count);
    }
    let number: f64 = text.parse().ok()?;
    // Conversion saturates.
    (number >= 1.0 && number.fract() == 0.0).then_some(number as usize)
}

#[cfg(test)]
mod tests {
    use super::{WITHOUT_UNIT, count, finite, significant};
    use core::f64::consts::PI;

    #[test]
    fn numbers_may_be_expressions() {
        for (text, expected) in [
            ("-2e-3", -2e-3),
            (" 1e-320 ", 1e-320),
            ("pi/3", PI / 3.0),
            ("-2*pi", -2.0 * PI),
            ("3/4", 0.75),
            ("sqrt(2)/2", 0.5_f64.sqrt()),
            ("2^10", 1024.0),
        ] {
            assert_eq!(finite(text), Ok(expected), "{text}");
        }
        for wrong in ["", "2 pi", "x", "(", "[1]", "'", "\"", "1 # 2", "2^sin"] {
            let told = finite(wrong).expect_err("no number");
            assert!(
                told.starts_with(&format!("`{wrong}` is not a number: ")),
                "{told}"
            );
        }
        for (wrong, why) in [
            ("1/0", "division by zero"),
            (
                "sqrt(-1)",
                "`sqrt(-1)` has no value; the numbers are outside of where it is defined",
            ),
            (
                "two",
                "`two` is not known; only numbers and `pi` stand here",
            ),
            ("2pi", "a product is written with `*`: `2*pi`"),
            ("PI/2", "`PI` is not known; did you mean `pi`?"),
            ("π/3", "`π` is not known; write `pi`"),
            ("30deg", "angles are in radians: 30° is `pi/6`"),
            (
                "1,2",
                "`,` is not an operator here; decimals are written with a point: `1.5`",
            ),
        ] {
            let told = format!("`{wrong}` is not a number: {why}");
            assert_eq!(finite(wrong), Err(told));
        }
        for with_unit in ["3s", "2 kg", "-1.5e3m/s", "1e-3 m^2", "5e", ".5µm"] {
            let told = format!("`{with_unit}` is not a number: {WITHOUT_UNIT}");
            assert_eq!(finite(with_unit), Err(told));
        }
        for wrong in ["inf", "nan", "1e999", "-inf"] {
            assert_eq!(finite(wrong), Err("the value must be finite".to_owned()));
        }
    }

    #[test]
    fn counts_are_read_in_both_notations() {
        for (text, expected) in [
            ("1", 1),
            (" 400 ", 400),
            ("1e6", 1_000_000),
            ("2.5e3", 2500),
            ("1e22", usize::MAX),
            ("18446744073709551616", usize::MAX),
        ] {
            assert_eq!(count(text), Some(expected), "{text}");
        }
        for wrong in ["", "0", "-1", "1.5", "1e-3", "inf", "nan", "x"] {
            assert_eq!(count(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn numbers_of_pictures_are_short_and_finite() {
        assert_eq!(significant(1.0 / 3.0), 0.333333);
        assert_eq!(significant(-0.0), 0.0);
        assert_eq!(significant(f64::NAN), 0.0);
    }
}
