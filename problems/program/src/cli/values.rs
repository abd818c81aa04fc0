//! `name=value` and numbers, as they come from the command line.

use crate::format::Still;
use crate::number::{count, finite};
use crate::request::{ERRORS, TOLERANCES};
use core::str::FromStr;
use std::path::PathBuf;

/// `name=value` with a finite value.
pub(super) fn named(text: &str) -> Result<(String, f64), String> {
    let Some((name, value)) = text.split_once('=') else {
        let text = text.trim();
        let example = match text.starts_with(|c: char| c.is_alphabetic()) {
            true => format!(", for example {text}=2"),
            false => String::new(),
        };
        return Err(format!("expected name=value{example}"));
    };
    let name = name.trim();
    if name.is_empty() {
        return Err(format!("expected a name before `={value}`"));
    }
    Ok((name.to_owned(), finite(value)?))
}

/// `name=value` of a coordinate or velocity at the start; a word alone may be meant as a named start.
pub(super) fn held(text: &str) -> Result<(String, f64), String> {
    named(text).map_err(|reason| match text.contains('=') {
        true => reason,
        false => format!(
            "{reason}; a named start is chosen with --from {}",
            text.trim()
        ),
    })
}

/// `name=value`, the value above zero.
pub(super) fn named_positive(text: &str) -> Result<(String, f64), String> {
    match named(text)? {
        (name, value) if value > 0.0 => Ok((name, value)),
        (name, _) => Err(format!("the value of `{name}` must be above 0")),
    }
}

/// A whole number that is not negative, as seeds are.
pub(super) fn whole<N: FromStr>(text: &str) -> Result<N, String> {
    let text = text.trim();
    text.parse()
        .map_err(|_| format!("`{text}` is not a whole number"))
}

/// A finite number above zero.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    match finite(text)? {
        value if value > 0.0 => Ok(value),
        _ => Err("the value must be above 0".to_owned()),
    }
}

/// A finite number from zero on.
pub(super) fn not_negative(text: &str) -> Result<f64, String> {
    match finite(text)? {
        value if value >= 0.0 => Ok(value),
        _ => Err("the value must not be below 0".to_owned()),
    }
}

/// A number of things, from `least` to `most` of them.
pub(super) fn number_of(
    things: &'static str,
    least: usize,
    most: usize,
) -> impl Fn(&str) -> Result<usize, String> + Clone {
    move |text| match count(text) {
        Some(count) if (least..=most).contains(&count) => Ok(count),
        Some(_) => Err(format!("there can be {least} to {most} {things}")),
        None => Err(format!("`{}` is not a number of {things}", text.trim())),
    }
}

/// A file for a picture, of a kind that can be written.
pub(super) fn picture(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let hint = match text.contains(" vs ") {
        true => "; what to draw is said with --show",
        false => "",
    };
    let known = Still::of(&path).map_err(|reason| format!("{reason}{hint}"));
    known.map(|_| path)
}

/// A file that a run is written down in.
pub(super) fn scene_file(text: &str) -> Result<PathBuf, String> {
    match text.ends_with(".toml") {
        true => Ok(PathBuf::from(text)),
        false => Err("let the name of a scene file end in .toml".to_owned()),
    }
}

/// A tolerance of an integration.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    match positive(text)? {
        tolerance if TOLERANCES.contains(&tolerance) => Ok(tolerance),
        _ => Err("a tolerance is between 1e-17 and 0.1".to_owned()),
    }
}

/// An error that a run is to keep.
pub(super) fn error(text: &str) -> Result<f64, String> {
    match positive(text)? {
        error if ERRORS.contains(&error) => Ok(error),
        _ => Err("an error is between 1e-15 and 0.1".to_owned()),
    }
}

/// One tolerance, or every power of ten from one to another (`1e-3..1e-15`), loosest first.
pub(super) fn tolerances(text: &str) -> Result<Vec<f64>, String> {
    let Some((from, to)) = text.split_once("..") else {
        return Ok(vec![tolerance(text)?]);
    };
    let power = |text: &str| -> Result<i32, String> {
        let power = tolerance(text)?.log10();
        match (power - power.round()).abs() < 1e-9 {
            true => Ok(power.round() as i32),
            false => Err("a range is between powers of ten, as 1e-3..1e-15".to_owned()),
        }
    };
    let (from, to) = (power(from)?, power(to)?);
    // Read from text: 10 to a power by multiplication is not the nearest double.
    let powers = (from.min(to)..=from.max(to)).rev();
    powers.map(|power| finite(&format!("1e{power}"))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_finite_numbers_pass() {
        assert_eq!(
            named("der(theta)=-2e-3"),
            Ok(("der(theta)".to_owned(), -2e-3))
        );
        assert_eq!(named(" mass = 2 "), Ok(("mass".to_owned(), 2.0)));
        let forgotten = "expected name=value, for example der(x)=2";
        assert_eq!(named("der(x)"), Err(forgotten.to_owned()));
        let start =
            "expected name=value, for example rest=2; a named start is chosen with --from rest";
        assert_eq!(held("rest"), Err(start.to_owned()));
        assert_eq!(held("x=two"), named("x=two"));
        for wrong in [
            "mass",
            "=2",
            "mass=",
            "mass=two",
            "mass=nan",
            "mass=inf",
            "mass=1e999",
        ] {
            assert!(named(wrong).is_err(), "{wrong}");
        }
        assert!(positive("0").is_err() && positive("-1").is_err() && positive("1e-12").is_ok());
        assert!(
            tolerance("0.2").is_err() && tolerance("1e-18").is_err() && tolerance("0.1").is_ok()
        );
    }

    #[test]
    fn tolerances_alone_and_in_ranges() {
        assert_eq!(tolerances("1e-9"), Ok(vec![1e-9]));
        let three = Ok(vec![1e-3, 1e-4, 1e-5]);
        assert_eq!(tolerances("1e-3..1e-5"), three);
        assert_eq!(tolerances("1e-5..0.001"), three);
        for wrong in ["2", "1e-18", "3e-4..1e-5", "1e-3..", "..", "x"] {
            assert!(tolerances(wrong).is_err(), "{wrong}");
        }
    }
}
