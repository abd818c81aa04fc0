//! `name=value` and numbers, as they come from the command line.

/// `name=value` with a finite value.
pub(super) fn named(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or("expected name=value, for example mass=2")?;
    let name = name.trim();
    if name.is_empty() {
        return Err("expected a name before `=`, for example mass=2".to_owned());
    }
    Ok((name.to_owned(), finite(value)?))
}

/// A finite number.
pub(super) fn finite(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err("the value must be finite".to_owned()),
        Err(_) => Err(format!("`{}` is not a number", text.trim())),
    }
}

/// A finite number above zero.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    match finite(text)? {
        value if value > 0.0 => Ok(value),
        _ => Err("the value must be above 0".to_owned()),
    }
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
    }
}
