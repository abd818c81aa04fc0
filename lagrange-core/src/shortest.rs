//! Numbers as messages show them.

use core::fmt;

/// A number in the fewest digits that are read back as it was: `0.1`, `20`, `1e308`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shortest(pub f64);

impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(number) = *self;
        // Where zeros would only say how small or large it is, an exponent does.
        match number == 0.0 || !number.is_finite() || (1e-5..1e16).contains(&number.abs()) {
            true => write!(f, "{number}"),
            false => write!(f, "{number:e}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Shortest;

    #[test]
    fn numbers_are_short_and_read_back_as_themselves() {
        for text in [
            "0",
            "-0",
            "1",
            "-20",
            "0.1",
            "0.00001",
            "9e-6",
            "0.30000000000000004",
            "1e308",
            "-1e-308",
            "5e-324",
            "1.7976931348623157e308",
            "123456.75",
            "1000",
            "0.00025",
            "1.5e-55",
            "1000000000000000",
            "1e16",
            "inf",
            "NaN",
        ] {
            let number: f64 = text.parse().expect("a number");
            assert_eq!(Shortest(number).to_string(), text);
        }
    }
}
