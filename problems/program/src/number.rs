//! Numbers as people write them: `1e-3`, `pi/3`; counts `400`, `1e6`.

/// A finite number, or an expression that is one.
///
/// # Errors
/// It is something else: what to say about it.
pub fn finite(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let number = match text.parse::<f64>() {
        Ok(number) => Some(number),
        Err(_) => lagrange_engine::number(text).ok(),
    };
    match number {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => Err("the value must be finite".to_owned()),
        None => Err(format!("`{text}` is not a number")),
    }
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
    use super::{count, finite};
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
        for wrong in [
            "", "two", "2 pi", "x", "1/0", "sqrt(-1)", "(", "1,2", "[1]", "'", "\"", "1 # 2",
        ] {
            assert_eq!(finite(wrong), Err(format!("`{wrong}` is not a number")));
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
}
