//! Which name did they mean?

use crate::accuracy::Family;
use lagrange_core::integrate::ParseMethodError;
use lagrange_core::prelude::Method;

/// The known name nearest to `name`, if it is near enough to be a slip of the finger.
///
/// Distance counts insertions, deletions, substitutions and swaps of neighbours (Damerau 1964); up to a third of
/// the letters may differ.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let distance = |candidate: &str| strsim::damerau_levenshtein(&name.to_lowercase(), candidate);
    let best = known
        .iter()
        .copied()
        .min_by_key(|candidate| distance(candidate))?;
    let allowed = name.chars().count().max(best.chars().count()).div_ceil(3);
    (distance(best) <= allowed).then_some(best)
}

/// The method called `name`.
///
/// # Errors
/// What is wrong with the name, with the nearest one that is known.
pub fn method(name: &str) -> Result<Method, String> {
    name.parse().map_err(|error| method_meant(name, &error))
}

/// The method called `name` for a study at several tolerances.
///
/// # Errors
/// As [`method`].
pub fn family(name: &str) -> Result<Family, String> {
    name.parse().map_err(|error| method_meant(name, &error))
}

fn method_meant(name: &str, error: &ParseMethodError) -> String {
    let known = Family::ALL.map(|family| family.to_string());
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    match (error, nearest(name, &known)) {
        (ParseMethodError::Unknown { name }, Some(near)) => {
            format!("no method is called `{name}`; did you mean `{near}`?")
        }
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_is_recognised_and_nonsense_is_not() {
        let known = ["mass-on-wheel", "mass-on-shell", "rolling-sphere"];
        assert_eq!(nearest("mass-on-whele", &known), Some("mass-on-wheel"));
        assert_eq!(nearest("Rolling-Sphere", &known), Some("rolling-sphere"));
        assert_eq!(nearest("pendulum", &known), None);
        assert_eq!(nearest("x", &[]), None);
    }
}
