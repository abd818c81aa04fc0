//! Counts as people write them: `400`, `1e6`.

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
    use super::count;

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
